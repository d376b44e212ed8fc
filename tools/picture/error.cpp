// In: a failure. Out: the text that frond_picture_last_error() returns to this thread.
#include "error.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "frond_picture.h"

namespace picture {

namespace {
// A plain array: storing a text must work when memory has run out.
thread_local char last_text[1024] = "";
}  // namespace

void fail(const char* format, ...) {
    char text[sizeof last_text];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    throw Error(text);
}

void remember(const char* text) noexcept {
    std::snprintf(last_text, sizeof last_text, "%s", text);
}

}  // namespace picture

const char* frond_picture_last_error(void) {
    return picture::last_text;
}
