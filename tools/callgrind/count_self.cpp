#include "callgrind/count_self.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace frond::tools {

bool begins_with(const std::string& line, const char* word) {
    return line.rfind(word, 0) == 0;
}

std::map<std::string, std::vector<std::string>> count_self(const std::string& arguments, const std::string& options) {
    const std::string trigger = "desc: Trigger: Client Request: ";
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("frond_callgrind_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = "valgrind --tool=callgrind -q " + options + " --callgrind-out-file='" +
                                (folder / "part").string() + "' '" + self + "' " + arguments + " > /dev/null 2>&1";
    std::map<std::string, std::vector<std::string>> parts;
    if (std::system(command.c_str()) == 0)
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            std::vector<std::string> lines;
            std::string name;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);) {
                if (begins_with(line, trigger.c_str())) name = line.substr(trigger.size());
                lines.push_back(std::move(line));
            }
            if (!name.empty()) parts[name] = std::move(lines);
        }
    std::filesystem::remove_all(folder);
    return parts;
}

}  // namespace frond::tools
