// Errors inside the library. They are thrown as Error and become a result code and a text at the C API, nowhere else.
#pragma once

#include <stdexcept>
#include <string>

#include "frond/frond.h"

namespace frond {

struct Error : std::runtime_error {
    frond_result code;
    Error(frond_result code, const std::string& text) : std::runtime_error(text), code(code) {}
};

// Throws an Error whose text is made as by printf: what was wrong, then what to do.
[[noreturn]] void fail(frond_result code, const char* format, ...) __attribute__((format(printf, 2, 3)));
// Text made as by printf.
std::string text_of(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace frond
