// Errors of the picture library: thrown inside, turned into a text at the C functions, nowhere else.
#pragma once

#include <stdexcept>
#include <string>

namespace picture {

struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Throws an Error whose text is made as by printf: what was wrong, then what to do.
[[noreturn]] void fail(const char* format, ...) __attribute__((format(printf, 1, 2)));
// Remembers the text for frond_picture_last_error().
void remember(const char* text) noexcept;

// Runs the body of a C function: true, or false with a remembered text. No exception gets out.
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
