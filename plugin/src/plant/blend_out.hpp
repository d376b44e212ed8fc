// BlendOut: the part of a shape and its motion that another detail cannot represent. It decreases to zero within a
// second, starting with its own velocity.
#pragma once

#include "core/types.hpp"

namespace frond {

struct BlendOut {
    VecX offset, rate;  // at the start, SPEED times the offset added to the rate [m], [m/s]
    double time = 0;    // time since then [s]
};

// What blends out of how a plant is seen (seen.hpp).
struct Blend {
    BlendOut turns;    // of the chain's nodes, in their frames; its places stay zero [rad]
    BlendOut surface;  // displacements of its vertices that those leave [m]
    BlendOut nodes;    // displacements of the cage's nodes [m]
};

// Begins with an offset and its rate; there is none if they are small already.
void begin_blend_out(BlendOut& blend_out, VecX offset, const VecX& rate);
// Advances time; ends a difference that is too small to be seen.
void pass_time(BlendOut& blend_out, double h);
inline bool is_over(const BlendOut& blend_out) {
    return blend_out.offset.size() == 0;
}
// Add what is left of the difference after a further time [s], and its rate now.
void add_offset(const BlendOut& blend_out, VecX& x, double after = 0);
void add_rate(const BlendOut& blend_out, VecX& v);

}  // namespace frond
