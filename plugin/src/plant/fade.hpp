// Fade: what of a shape and its motion another detail cannot have, and goes within a second, at first as it went on.
#pragma once

#include "core/types.hpp"

namespace frond {

struct Fade {
    VecX offset, rate;  // at the start, the second with SPEED times the first added [m], [m/s]
    double time = 0;    // since then [s]
};

// From an offset and its rate; none if they are small already.
void begin_fade(Fade& fade, VecX offset, const VecX& rate);
// Time goes on; ends what is too small to be seen.
void pass_time(Fade& fade, double h);
inline bool is_over(const Fade& fade) {
    return fade.offset.size() == 0;
}
// Adds what is left of it, and how that changes.
void add_offset(const Fade& fade, VecX& x);
void add_rate(const Fade& fade, VecX& v);

}  // namespace frond
