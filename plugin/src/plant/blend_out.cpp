// (offset + rate t) exp(-SPEED t): shape and velocity continue without a jump, and nothing oscillates.
#include "plant/blend_out.hpp"
#include "core/assert.hpp"
#include "core/elementary.hpp"

namespace frond {

constexpr double SPEED = 4;      // [1/s]
constexpr double UNSEEN = 1e-5;  // [m], [rad]

void begin_blend_out(BlendOut& blend_out, VecX offset, const VecX& rate) {
    FROND_ASSERT(offset.size() == rate.size());
    blend_out = {};
    if (offset.lpNorm<Eigen::Infinity>() < UNSEEN && rate.lpNorm<Eigen::Infinity>() < SPEED * UNSEEN) return;
    blend_out.rate = rate + SPEED * offset;
    blend_out.offset = std::move(offset);
}

void pass_time(BlendOut& blend_out, double h) {
    if (is_over(blend_out)) return;
    blend_out.time += h;
    const double most =
        blend_out.offset.lpNorm<Eigen::Infinity>() + blend_out.time * blend_out.rate.lpNorm<Eigen::Infinity>();
    if (most * frond::exp(-SPEED * blend_out.time) < UNSEEN) blend_out = {};
}

void add_offset(const BlendOut& blend_out, VecX& x, double after) {
    FROND_ASSERT(is_over(blend_out) || x.size() == blend_out.offset.size());
    const double time = blend_out.time + after;
    if (!is_over(blend_out)) x += frond::exp(-SPEED * time) * (blend_out.offset + time * blend_out.rate);
}

void add_rate(const BlendOut& blend_out, VecX& v) {
    if (is_over(blend_out)) return;
    v += frond::exp(-SPEED * blend_out.time) *
         (blend_out.rate - SPEED * (blend_out.offset + blend_out.time * blend_out.rate));
}

}  // namespace frond
