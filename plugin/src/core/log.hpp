// Warnings to the host: things that were put right, and what to look at.
#pragma once

#include "frond/frond.h"

namespace frond {

void set_log(frond_log_fn* log, void* user);
void warn(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace frond
