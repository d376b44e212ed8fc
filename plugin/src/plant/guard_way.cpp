// In: a plant before and after a solve. Out: whether one of its nodes moved as in no healthy step.
//
// Every step is checked, but such nodes are rare: several nodes are first checked together, in the lanes of the vector
// unit.
#include <cmath>

#include "core/elementary.hpp"
#include "core/lanes.hpp"
#include "plant/guard.hpp"
#include "plant/plant_step.hpp"

namespace frond {

namespace {

// The part of a motion that is checked: numbers from `k` on.
struct Way {
    const VecX &x, &from;
    template <class S>
    FROND_INLINE S at(int k) const {
        return load<S>(x.data() + k) - load<S>(from.data() + k);
    }
};
struct OffCourse {
    const VecX &x, &from, &v;
    double h;  // [s]
    template <class S>
    FROND_INLINE S at(int k) const {
        return load<S>(x.data() + k) - load<S>(from.data() + k) - constant<S>(h) * load<S>(v.data() + k);
    }
};

// Finds whether some node satisfies `is_one`, which is called only for groups of nodes in which a square may exceed its
// limit, `even` or `odd` by the node's index.
template <class Of, class IsOne>
struct FindNode {
    const Of& of;
    int count;
    double even, odd;
    const IsOne& is_one;
    bool& found;
    template <class S>
    FROND_INLINE void run() const {
        constexpr int NODES = 4 * LANES<S>;  // nodes per group
        S share[3];                          // reciprocal limits of the squares
        for (int k = 0; k < 3 * LANES<S>; k++)
            set_lane(share[k / LANES<S>], k % LANES<S>, 1 / (k / 3 % 2 ? odd : even));
        int node = 0;
        for (; node + NODES <= count; node += NODES) {
            S sum = {};
            for (int k = 0; k < 12; k++) {
                const S off = of.template at<S>(3 * node + k * LANES<S>);
                sum += share[k % 3] * off * off;
            }
            if (any(!(sum < constant<S>(1.0 / LANES<S>))) && has_one(node, node + NODES)) return;
        }
        has_one(node, count);
    }
    bool has_one(int node, int to) const {
        while (node < to && !is_one(node)) node++;
        return found = node < to;
    }
};
template <class Of, class IsOne>
bool has_node(const Of& of, int count, double even, double odd, const IsOne& is_one) {
    bool found = false;
    run_in_lanes(FindNode<Of, IsOne>{of, count, even, odd, is_one, found});
    return found;
}

// Returns whether all positions, but not the rotations of a chain, are nearer to `from` than `distance`.
bool are_near(const Plant& plant, const VecX& from, double distance) {
    const VecX& x = plant.state.motion.x;
    const double most = distance * distance;
    const auto is_far = [&](int i) {
        return (!plant.follow || i % 2 == 0) && !((point(x, i) - point(from, i)).squaredNorm() < most);
    };
    return !has_node(Way{x, from}, int(x.size() / 3), most, plant.follow ? INFINITY : most, is_far);
}

// Returns the largest distance of a node from its place in `from` [m]; infinite if one is not a number.
double farthest(const Plant& plant, const VecX& x, const VecX& from) {
    double most = 0;
    for (int i = 0; i < x.size() / 3; i += plant.follow ? 2 : 1) {
        const double way = (point(x, i) - point(from, i)).squaredNorm();
        if (!(way <= most)) most = std::isnan(way) ? INFINITY : way;
    }
    return std::sqrt(most);
}

// Returns the largest distance of a node from its modelled position at the start of the step [m].
double reach_at_start(const Plant& plant) {
    return farthest(plant, plant.step.x_good, elements_of(*plant.system).modelled);
}

}  // namespace

double farthest_way(const Plant& plant) {
    return farthest(plant, plant.state.motion.x, plant.step.x_good);
}

bool whips_among_bodies(const Plant& plant) {
    return plant.step.is_among_bodies && plant.step.x_good.size() > 0 && farthest_way(plant) > WHIPS;
}

bool ends_off_course(const Plant& plant, double h) {
    if (h > TRUSTED) return true;
    const VecX &x = plant.state.motion.x, &x_good = plant.step.x_good, &v_good = plant.step.v_good;
    const double far = squared(OFF_COURSE * double(plant.size));
    const double turned_far = plant.follow ? TURNED_OFF_COURSE * TURNED_OFF_COURSE : far;
    const auto is_off = [&](int i) {
        const double off = (point(x, i) - point(x_good, i) - h * point(v_good, i)).squaredNorm();
        if (off < (i % 2 ? turned_far : far)) return false;
        const Vec3 end = wound_as(Vec3(point(x_good, i)), Vec3(point(x, i)));
        return !plant.follow || i % 2 == 0 ||
               !((end - point(x_good, i) - h * point(v_good, i)).squaredNorm() < turned_far);
    };
    return has_node(OffCourse{x, x_good, v_good, h}, int(x.size() / 3), far, turned_far, is_off);
}

bool has_run_away(const Plant& plant) {
    constexpr double BACK = 2;  // displacement in a step over the distance to the modelled shape [-]
    const double size = double(plant.size);
    return !are_near(plant, plant.step.x_good, FARTHEST_WAY * size) &&
           !are_near(plant, plant.step.x_good, FARTHEST_WAY * size + BACK * reach_at_start(plant));
}

bool is_far_out(const Plant& plant) {
    constexpr double FARTHEST = 100;  // of a node from its modelled place, in sizes of the plant [-]
    return !are_near(plant, elements_of(*plant.system).modelled, FARTHEST * double(plant.size));
}

}  // namespace frond
