// (offset + rate t) exp(-SPEED t): the shape and its velocity go on without a jump, and nothing swings.
#include "plant/fade.hpp"

#include <cmath>

namespace frond {

constexpr double SPEED = 4;      // [1/s]
constexpr double UNSEEN = 1e-6;  // [m]

void begin_fade(Fade& fade, VecX offset, const VecX& rate) {
    fade = {};
    if (offset.lpNorm<Eigen::Infinity>() < UNSEEN && rate.lpNorm<Eigen::Infinity>() < SPEED * UNSEEN) return;
    fade.rate = rate + SPEED * offset;
    fade.offset = std::move(offset);
}

void pass_time(Fade& fade, double h) {
    if (is_over(fade)) return;
    fade.time += h;
    const double most = fade.offset.lpNorm<Eigen::Infinity>() + fade.time * fade.rate.lpNorm<Eigen::Infinity>();
    if (most * std::exp(-SPEED * fade.time) < UNSEEN) fade = {};
}

void add_offset(const Fade& fade, VecX& x) {
    if (!is_over(fade)) x += std::exp(-SPEED * fade.time) * (fade.offset + fade.time * fade.rate);
}

void add_rate(const Fade& fade, VecX& v) {
    if (is_over(fade)) return;
    v += std::exp(-SPEED * fade.time) * (fade.rate - SPEED * (fade.offset + fade.time * fade.rate));
}

}  // namespace frond
