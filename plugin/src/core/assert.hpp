// FROND_ASSERT: what the code relies on, said where it relies on it. A condition that does not hold is an error of
// Frond's own; what a caller or a file may have wrong is an Error (core/error.hpp).
//
// With FROND_ASSERTS (an option of the build; on in the presets for work on Frond) a failed condition calls a handler;
// without, conditions are compiled but not evaluated, and cost nothing.
#pragma once

namespace frond {

// Gets the condition's text and its place. Where it returns, the program goes on.
using AssertHandler = void(const char* condition, const char* file, int line);

// Replaces the handler of all threads and returns the one before. Null: the first one, which writes to standard error
// and aborts.
AssertHandler* set_assert_handler(AssertHandler* handler);

// Calls the handler.
void tell_failed_assert(const char* condition, const char* file, int line);

}  // namespace frond

#ifdef FROND_ASSERTS
#define FROND_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::frond::tell_failed_assert(#condition, __FILE__, __LINE__))
#else
#define FROND_ASSERT(condition) static_cast<void>(false && (condition))
#endif
