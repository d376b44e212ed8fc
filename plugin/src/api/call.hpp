// Call: the frame of every public function. Checks arguments; turns exceptions into a result and a text.
#pragma once

#include <cstring>
#include <new>

#include "core/convert.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"

namespace frond {

// Remembers the text of a failed call for frond_last_error(); returns the code.
frond_result report_failure(frond_result code, const char* text) noexcept;

template <class Body>
frond_result call(Body&& body) noexcept {
    try {
        body();
        return FROND_OK;
    } catch (const Error& error) {
        return report_failure(error.code, error.what());
    } catch (const std::bad_alloc&) {
        return report_failure(FROND_RESULT_OUT_OF_MEMORY, "out of memory; use a coarser cage or fewer plants");
    } catch (const std::exception& error) {
        return report_failure(FROND_RESULT_INTERNAL, error.what());
    } catch (...) {
        return report_failure(FROND_RESULT_INTERNAL, "an unknown exception");
    }
}

// Arguments. `name` is what the header calls the argument.
template <class T>
void check_pointer(const T* pointer, const char* name) {
    if (!pointer) fail(FROND_RESULT_BAD_ARGUMENT, "%s is null; pass a valid pointer", name);
}
// The frame of a function that returns something by `out`, which is zero unless all goes well.
template <class Out, class Body>
frond_result give(Out* out, Body&& body) noexcept {
    return call([&] {
        check_pointer(out, "out");
        *out = {};
        *out = body();
    });
}
inline void check_range(double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
        fail(FROND_RESULT_BAD_ARGUMENT, "%s is %g; it must be in %g .. %g", name, value, low, high);
}
inline void check_vec(const frond_vec3& p, const char* name) {
    for (double value : {p.x, p.y, p.z}) check_range(value, -LARGEST_COORDINATE, LARGEST_COORDINATE, name);
}
// Returns a rotation as a quaternion of length one.
inline Quat checked_rotation(const frond_quat& rotation, const char* name) {
    const Quat turn = to_quat(rotation);
    const double length = turn.norm();
    if (!(length > 1e-9 && length < 1e9))
        fail(FROND_RESULT_BAD_ARGUMENT, "%s has no direction; (0,0,0,1) turns nothing", name);
    return turn.normalized();
}
inline void check_count(int given, int own, const char* name, const char* whose = "plant") {
    if (given != own) fail(FROND_RESULT_BAD_ARGUMENT, "%s is %d; this %s has %d", name, given, whose, own);
}
inline void check_effects(frond_effects effects, const char* name) {
    if (effects & ~uint32_t(FROND_EFFECT_ALL))
        fail(FROND_RESULT_BAD_ARGUMENT, "%s has unknown bits; use FROND_EFFECT_*", name);
}
// Checks a name or a path: none in a file system or a mesh is longer than the limit.
inline void check_text(const char* text, const char* name) {
    constexpr size_t LONGEST = 4096;  // of a path on Linux [byte]
    check_pointer(text, name);
    if (strnlen(text, LONGEST + 1) > LONGEST)
        fail(FROND_RESULT_BAD_ARGUMENT, "%s has more than %zu characters; pass a shorter one", name, LONGEST);
}
// Returns the number in an enum that a caller wrote: it may be out of the enum's range, so it is not read as the enum.
template <class Enum>
int number_of(const Enum& value) {
    int number;
    static_assert(sizeof value == sizeof number, "C enums are ints");
    std::memcpy(&number, &value, sizeof number);
    return number;
}
template <class Enum>
void check_row(const Enum& row, int count, const char* name) {
    const int number = number_of(row);
    if (number < 0 || number >= count)
        fail(FROND_RESULT_BAD_ARGUMENT, "%s is %d; use one of its enum's names", name, number);
}
// A def's cookie is its kind, a letter, and the version of the header that it was made by: see FROND_DEF_COOKIE. Patch
// versions are compatible.
inline bool is_of_this_version(uint32_t cookie) {
    return (cookie & 0xffff00) == (uint32_t(FROND_VERSION) & 0xffff00);
}
template <class Def>
void check_def(const Def* def, char kind, const char* name) {
    check_pointer(def, "def");
    const uint32_t cookie = def->cookie;
    if (cookie >> 24 != uint32_t(kind))
        fail(FROND_RESULT_BAD_DEF, "the def was not made by frond_default_%s_def(); start from it", name);
    if (!is_of_this_version(cookie))
        fail(FROND_RESULT_BAD_DEF,
             "the def was made by the header of version %u.%u.%u, but the library is version %s; compile with its "
             "headers",
             cookie >> 16 & 255, cookie >> 8 & 255, cookie & 255, FROND_VERSION_STRING);
}

}  // namespace frond
