// Sanitizers look for faults of memory and language, not of mechanics: sweeps over figures, which the optimised tests
// make in full, may be shorter for them.
#pragma once

#ifdef __SANITIZE_ADDRESS__
constexpr bool SANITIZED = true;
#else
constexpr bool SANITIZED = false;
#endif
