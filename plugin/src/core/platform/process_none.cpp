// Systems without processes, such as a browser's: nothing is started, and there is no program but this one.
#include <cstdlib>
#include <system_error>

#include "core/platform/process.hpp"

namespace frond {

const char BETWEEN_PATHS = ':';
const char* const PROGRAM_ENDING = "";

struct Child::Inside {};

Child::Child(const std::string&, const std::vector<std::string>&, const ProcessLimits&) {
    throw std::system_error(std::make_error_code(std::errc::function_not_supported));
}
Child::~Child() = default;
bool Child::hear(double, std::string&, std::string&) {
    return false;
}
ChildEnd Child::end(bool) {
    return {};
}

std::vector<std::string> own_arguments(int count, char** words) {
    return {words, words + count};
}
void limit_self(const ProcessLimits&) {}
bool is_output_a_terminal() {
    return false;
}
bool write_output(const std::string&) {
    return false;
}
void leave(int status) {
    std::_Exit(status);
}
std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}
bool is_program(const std::string&) {
    return false;
}
std::vector<std::string> own_folders() {
    return {};
}

}  // namespace frond
