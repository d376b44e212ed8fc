// Calls of the C API that have to succeed.
#pragma once

#include <stdexcept>

#include "frond/frond.h"

namespace frond::test {

// Throws the library's error text, which ends a test or a program.
inline void must(frond_result result) {
    if (result != FROND_OK) throw std::runtime_error(frond_last_error());
}

}  // namespace frond::test
