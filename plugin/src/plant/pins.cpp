// Pins: cage nodes held where they are put. Where the cage itself moves they are nodes of the mechanics. Where it
// follows the chain, three pinned nodes or more that hang on one chain node hold that, place and rotation; fewer are
// held by springs much stiffer than the plant.
#include <algorithm>
#include <map>

#include "mechanics/rotation.hpp"
#include "plant/plant.hpp"

namespace frond {

void pin_node(Plant& plant, int node) {
    point(plant.pin_target, node) = point(cage_places(plant), node);
    plant.pinned[size_t(node)] = 1;
    plant.pins_changed = true;
    if (plant.follow) return;
    point(plant.motion.v, node).setZero();
    point(plant.motion.pin_target, node) = point(plant.motion.x, node);
}

void unpin_node(Plant& plant, int node) {
    plant.pinned[size_t(node)] = 0;
    plant.pins_changed = true;
}

void move_pin(Plant& plant, int node, const Vec3& target) {
    point(plant.pin_target, node) = target;
    plant.pins_changed = true;
}

// The rotation vector of R, on that side of the half turn on which the node is now.
static Vec3 nearest_vector(const Mat3& R, const Vec3& now) {
    const Vec3 turn = rotation_vector<double>(R);
    const double angle = turn.norm();
    if (angle < 1e-6) return turn;
    const Vec3 other = turn * (1 - 2 * M_PI / angle);
    return (other - now).squaredNorm() < (turn - now).squaredNorm() ? other : turn;
}

// A plant stiffer than this many times its weight over a millimetre is not told from a rigid one [-].
static double pin_stiffness(const Plant& plant) {
    constexpr double STRONG = 1e7;
    return STRONG * std::max(node_mass_of(*plant.system).sum(), 1e-6) * GRAVITY / 1e-3;
}

static void pin_chain(Plant& plant) {
    Motion& motion = plant.motion;
    std::fill(motion.pinned.begin(), motion.pinned.end(), uint8_t(0));
    plant.pin_springs.clear();
    std::map<int, std::vector<int>> held;  // chain node -> cage nodes
    for (size_t n = 0; n < plant.pinned.size(); n++)
        if (plant.pinned[n]) held[plant.anchor[n]].push_back(int(n));
    for (const auto& [chain_node, nodes] : held) {
        std::vector<Vec3> from, to;
        for (int n : nodes) {
            from.push_back(point(plant.follow->modelled, n));
            to.push_back(point(plant.pin_target, n));
        }
        Mat3 rotation;
        Vec3 image;
        if (fit_rigid(from, to, plant.model->chain.nodes[size_t(chain_node)].position, rotation, image)) {
            const int place = 2 * chain_node, turn = place + 1;
            motion.pinned[size_t(place)] = motion.pinned[size_t(turn)] = 1;
            point(motion.pin_target, place) = image;
            point(motion.pin_target, turn) = nearest_vector(rotation, point(motion.x, turn));
            continue;
        }
        for (size_t k = 0; k < nodes.size(); k++)
            plant.pin_springs.push_back({plant.follow->grips[size_t(nodes[k])], to[k], pin_stiffness(plant)});
    }
}

void apply_pins(Plant& plant) {
    // The side of the half turn may have changed since; a chain has few pins.
    if (plant.follow) {
        pin_chain(plant);
    } else if (plant.pins_changed) {
        plant.motion.pinned = plant.pinned;
        plant.motion.pin_target = plant.pin_target;
    }
    plant.pins_changed = false;
}

}  // namespace frond
