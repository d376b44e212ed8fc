// Numbers from text, whatever the host's locale.
#pragma once

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace frond {

// For libraries that read whole numbers only. The locale is that of the C library, whose decimal point is a point in a
// browser, where this serves.
template <class Number>
std::from_chars_result read_real(const char* begin, const char* end, Number& value) {
    char text[128] = {};
    size_t count = 0;
    while (begin + count < end && count + 1 < sizeof text && std::strchr("+-.0123456789eEinfatyINFATY", begin[count]))
        count++;
    std::memcpy(text, begin, count);
    char* after = text;
    const double number = count > 0 && text[0] != '+' ? std::strtod(text, &after) : 0;
    if (after == text) return {begin, std::errc::invalid_argument};
    value = Number(number);
    return {begin + (after - text), std::errc()};
}

// Reads the number at the beginning of a text as std::from_chars does, which not every standard library has for
// floating point.
template <class Number>
std::from_chars_result read_number(const char* begin, const char* end, Number& value) {
#ifndef __cpp_lib_to_chars
    if constexpr (std::is_floating_point_v<Number>)
        return read_real(begin, end, value);
    else
#endif
        return std::from_chars(begin, end, value);
}

}  // namespace frond
