// Errors of the picture library: thrown inside it, converted to a text only in the C functions.
#pragma once

#include <stdexcept>
#include <string>

namespace picture {

struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Throws an Error whose text is formatted as by printf: first the cause, then the remedy.
[[noreturn]] void fail(const char* format, ...) __attribute__((format(printf, 1, 2)));
// Stores the text for frond_picture_last_error().
void remember(const char* text) noexcept;

// Runs the body of a C function; returns true, or false with a stored text. No exception escapes.
template <class Body>
bool guarded(Body&& body) noexcept {
    try {
        body();
        return true;
    } catch (const std::bad_alloc&) {
        remember("out of memory; make the picture or the mesh smaller");
    } catch (const std::exception& error) {
        remember(error.what());
    } catch (...) {
        remember("an unknown exception, please report it");
    }
    return false;
}

}  // namespace picture
