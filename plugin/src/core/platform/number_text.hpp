// Numbers from text, whatever the host's locale.
#pragma once

#include <charconv>

namespace frond {

// Reads the number at the beginning of a text as std::from_chars does, which not every standard library has for
// floating point.
template <class Number>
std::from_chars_result read_number(const char* begin, const char* end, Number& value) {
    return std::from_chars(begin, end, value);
}

}  // namespace frond
