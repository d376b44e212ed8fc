// In: two segments before and after. Out: when they are in one plane, which is a root of a cubic in time, and whether
// they meet there.
#include "stability/crossing.hpp"

#include <algorithm>

#include "scenes/vector.hpp"

namespace frond::stability {

namespace {

using tools::cross;
using tools::dot;
using tools::operator+;
using tools::operator-;
using tools::operator*;

Segment at(const Segment& before, const Segment& after, double time) {
    return {before[0] + time * (after[0] - before[0]), before[1] + time * (after[1] - before[1])};
}

struct Pair {
    const Segment &a_before, &a_after, &b_before, &b_after;
};

// Six times the volume of the tet of both segments: zero where they are in one plane.
double volume(const Pair& pair, double time) {
    const Segment a = at(pair.a_before, pair.a_after, time), b = at(pair.b_before, pair.b_after, time);
    return dot(cross(a[1] - a[0], b[1] - b[0]), b[0] - a[0]);
}

// Returns whether two segments in one plane meet. The far ends belong to the next segments.
bool meet(const Segment& a, const Segment& b) {
    const frond_vec3 u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0], normal = cross(u, v);
    const double square = dot(normal, normal);
    if (square == 0) return false;
    const double along = dot(cross(w, v), normal) / square, beside = dot(cross(w, u), normal) / square;
    return along >= 0 && along < 1 && beside >= 0 && beside < 1;
}

bool are_apart(const Pair& pair) {
    for (double frond_vec3::*axis : {&frond_vec3::x, &frond_vec3::y, &frond_vec3::z}) {
        const auto range = [axis](const Segment& before, const Segment& after) {
            return std::minmax({before[0].*axis, before[1].*axis, after[0].*axis, after[1].*axis});
        };
        const auto a = range(pair.a_before, pair.a_after), b = range(pair.b_before, pair.b_after);
        if (a.first > b.second || b.first > a.second) return true;
    }
    return false;
}

int crossings_of(const Pair& pair) {
    constexpr int PARTS = 64, HALVINGS = 40;
    if (are_apart(pair)) return 0;
    int sum = 0;
    double last = volume(pair, 0);
    for (int part = 1; part <= PARTS; part++) {
        const double now = volume(pair, double(part) / PARTS);
        if ((last > 0) != (now > 0)) {
            double low = double(part - 1) / PARTS, high = double(part) / PARTS;
            for (int i = 0; i < HALVINGS; i++) {
                const double middle = 0.5 * (low + high);
                ((volume(pair, middle) > 0) == (last > 0) ? low : high) = middle;
            }
            if (meet(at(pair.a_before, pair.a_after, low), at(pair.b_before, pair.b_after, low)))
                sum += now > 0 ? 1 : -1;
        }
        last = now;
    }
    return sum;
}

}  // namespace

int crossings(const Core& a_before, const Core& a_after, const Core& b_before, const Core& b_after) {
    int sum = 0;
    for (size_t i = 0; i < a_before.size(); i++)
        for (size_t k = 0; k < b_before.size(); k++)
            sum += crossings_of({a_before[i], a_after[i], b_before[k], b_after[k]});
    return sum;
}

}  // namespace frond::stability
