// What compilers are told beyond the standard.
#pragma once

// Functions, and lambdas (after their parameters), that have to be inlined.
#define FROND_INLINE [[gnu::always_inline]] inline
#define FROND_INLINED __attribute__((always_inline))

// The text and the first value of a printf-style function, counted from 1; a method's object is the first argument.
#if defined(__MINGW32__)
#define FROND_PRINTF(text, values) __attribute__((format(gnu_printf, text, values)))
#else
#define FROND_PRINTF(text, values) __attribute__((format(printf, text, values)))
#endif
