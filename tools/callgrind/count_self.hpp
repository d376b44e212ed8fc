// This program once more, inside valgrind's callgrind, which counts instructions: the same number in every run.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace frond::tools {

// What callgrind wrote at each CALLGRIND_DUMP_STATS_AT, line by line, under the name that was given there. The program
// is run with `arguments`, valgrind with `options`. Empty where there is no valgrind, or the program failed in it.
std::map<std::string, std::vector<std::string>> count_self(const std::string& arguments, const std::string& options);

// Does a line of it begin with that?
bool begins_with(const std::string& line, const char* word);

}  // namespace frond::tools
