// Sanitizers look for errors of memory and language, not of mechanics: tests that sweep over many values, which run in
// full when optimised, may be shorter with them.
#pragma once

#ifdef __SANITIZE_ADDRESS__
constexpr bool SANITIZED = true;
#else
constexpr bool SANITIZED = false;
#endif
