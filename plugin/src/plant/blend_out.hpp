// BlendOut: what of a shape and its motion another detail cannot have, and goes within a second, at first as it went
// on.
#pragma once

#include "core/types.hpp"

namespace frond {

struct BlendOut {
    VecX offset, rate;  // at the start, the second with SPEED times the first added [m], [m/s]
    double time = 0;    // since then [s]
};

// From an offset and its rate; none if they are small already.
void begin_blend_out(BlendOut& blend_out, VecX offset, const VecX& rate);
// Time goes on; ends what is too small to be seen.
void pass_time(BlendOut& blend_out, double h);
inline bool is_over(const BlendOut& blend_out) {
    return blend_out.offset.size() == 0;
}
// Adds what is left of it, and how that changes.
void add_offset(const BlendOut& blend_out, VecX& x);
void add_rate(const BlendOut& blend_out, VecX& v);

}  // namespace frond
