// Runs this program again inside Valgrind's callgrind, which counts instructions: the same number in every run.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace frond::tools {

// Returns what callgrind wrote at each CALLGRIND_DUMP_STATS_AT, line by line, under the name given there. Runs the
// program with `arguments` and Valgrind with `options`. Empty if Valgrind is missing, was missing when
// the program was built, or if the program failed in it.
std::map<std::string, std::vector<std::string>> count_self(const std::string& arguments, const std::string& options);

// Returns whether a line begins with that word.
bool begins_with(const std::string& line, const char* word);

}  // namespace frond::tools
