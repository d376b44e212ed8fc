#include <cmath>
#include <cstdio>

#include "commands.hpp"

namespace frond::tools {

CLI::Validator real_in(double least, double most) {
    char range[80];
    std::snprintf(range, sizeof range, "%g to %g", least, most);
    return CLI::Validator(
        [=, text = std::string(range)](std::string& input) {
            double value = 0;
            const bool is_in = CLI::detail::lexical_cast(input, value) && value >= least && value <= most;
            return is_in ? std::string() : input + " is not a number from " + text;
        },
        range);
}

CLI::Validator file_ending_in(const std::string& ending) {
    return CLI::Validator(
        [=](std::string& input) {
            const bool has_it = input.size() > ending.size() &&
                                CLI::detail::to_lower(input.substr(input.size() - ending.size())) == ending;
            return has_it ? std::string() : input + " does not end in " + ending + ", which is what is written";
        },
        "*" + ending);
}

}  // namespace frond::tools
