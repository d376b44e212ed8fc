// Shrink: a program that breaks a law, made as short as it can be while it breaks the same law.
#pragma once

#include <functional>

#include "programs/program.hpp"

namespace frond::programs {

// Returns whether the program still breaks the law; called often.
using StillBreaks = std::function<bool(const Program&)>;
// Removes operations (delta debugging), then makes their numbers usual, fewer or rounder, as long as the law stays
// broken. Ends early when `is_over` says so.
Program shrink(Program program, const StillBreaks& still_breaks, const std::function<bool()>& is_over);

}  // namespace frond::programs
