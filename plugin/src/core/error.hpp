// Errors inside the library: thrown as Error, and turned into a result code and a text at the C API only.
#pragma once

#include <stdexcept>
#include <string>

#include "core/platform/compiler.hpp"
#include "frond/frond.h"

namespace frond {

struct Error : std::runtime_error {
    frond_result code;
    Error(frond_result code, const std::string& text) : std::runtime_error(text), code(code) {}
};

// Throws an Error with a printf-style text that says what was wrong, then what to do.
[[noreturn]] void fail(frond_result code, const char* format, ...) FROND_PRINTF(2, 3);
// Returns a printf-style text.
std::string text_of(const char* format, ...) FROND_PRINTF(1, 2);

}  // namespace frond
