// Warnings to the host: what was repaired, and what to check.
#pragma once

#include "core/platform/compiler.hpp"
#include "frond/frond.h"

namespace frond {

void set_log(frond_log_fn* log, void* user);
void warn(const char* format, ...) FROND_PRINTF(1, 2);

}  // namespace frond
