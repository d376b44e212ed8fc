// Pins: cage nodes held where they are put. If the mechanics move the cage, they are nodes of the mechanics. If it
// follows the chain, three or more pinned nodes that are attached to one chain node hold that, position and rotation;
// fewer are held by springs much stiffer than the plant. Pins do not hold a chain node that has a support.
#include "plant/pins.hpp"

#include <algorithm>
#include <map>

#include "core/assert.hpp"
#include "mechanics/rotation.hpp"

namespace frond {

bool is_pinned(const Plant& plant, int node) {
    return (plant.input.pinned.empty() ? plant.input.foot->pinned : plant.input.pinned)[size_t(node)];
}

void pin_node(Plant& plant, int node) {
    point(plant.input.pin_target, node) = point(cage_places(plant), node);
    plant.input.pinned[size_t(node)] = 1;
    plant.input.pins_changed = plant.input.pins_are_own = true;
    if (plant.follow) return;
    point(plant.state.motion.v, node).setZero();
    plant.state.motion.history.valid = false;
    point(plant.state.motion.pin_target, node) = point(plant.state.motion.x, node);
}

void unpin_node(Plant& plant, int node) {
    plant.input.pinned[size_t(node)] = 0;
    plant.input.pins_changed = plant.input.pins_are_own = true;
}

void move_pin(Plant& plant, int node, const Vec3& target) {
    FROND_ASSERT(node >= 0 && node < node_count_of(plant) && target.allFinite());
    point(plant.input.pin_target, node) = target;
    plant.input.pins_changed = plant.input.pins_are_own = true;
}

// Returns a spring's stiffness, STRONG times the plant's weight over a millimetre: with it a plant counts as rigidly
// held.
static double pin_stiffness(const Plant& plant) {
    constexpr double STRONG = 1e5;  // weights of the plant for a millimetre [-]
    return STRONG * std::max(node_mass_of(*plant.system).sum(), 1e-6) * GRAVITY / 1e-3;
}

// Cage nodes that are held together.
struct PinGroup {
    std::vector<int> nodes;
    std::vector<Vec3> from, to;  // modelled and target positions [m]
    bool stands = false;         // the ground holds some of them
};

static void add_to_group(const Plant& plant, int node, PinGroup& group) {
    group.nodes.push_back(node);
    group.stands |= plant.input.foot->pinned[size_t(node)] != 0;
    group.from.push_back(point(plant.follow->modelled, node));
    group.to.push_back(point(plant.input.pin_target, node));
}

// Holds a chain node by the rigid motion of the group; false if that leaves its rotation undetermined.
static bool hold_chain_node(Plant& plant, int chain_node, const PinGroup& group) {
    Mat3 rotation;
    Vec3 image;
    if (!fit_rigid(group.from, group.to, plant.model->chain.nodes[size_t(chain_node)].position, rotation, image))
        return false;
    Motion& motion = plant.state.motion;
    const int place = 2 * chain_node, turn = place + 1;
    motion.pinned[size_t(place)] = motion.pinned[size_t(turn)] = 1;
    point(motion.pin_target, place) = image;
    point(motion.pin_target, turn) = wound_as(Vec3(point(motion.x, turn)), rotation_vector<double>(rotation));
    return true;
}

// Returns the chain node that holds a pinned cage node. One that the ground does not hold may have been pinned while
// tets moved, and then has no anchor.
static int chain_node_that_holds(const Plant& plant, size_t node) {
    return plant.input.foot->pinned[node] ? plant.input.anchor[node] : plant.follow->nearest[node];
}

// Returns where a cage node is that is rigid with a chain node.
static Vec3 place_rigid_with(const Plant& plant, int chain_node, int node) {
    const VecX& x = plant.state.motion.x;
    const Vec3 arm = point(plant.follow->modelled, node) - plant.model->chain.nodes[size_t(chain_node)].position;
    return point(x, 2 * chain_node) + rotation_of<double>(point(x, 2 * chain_node + 1)) * arm;
}

void place_pinned_as_held(const Plant& plant, VecX& places) {
    const Motion& motion = plant.state.motion;
    if (!plant.follow) return;
    for (size_t n = 0; n < plant.input.pinned.size(); n++) {
        if (!plant.input.pinned[n]) continue;
        const int by = chain_node_that_holds(plant, n);
        if (!motion.pinned[size_t(2 * by)]) continue;
        point(places, int(n)) = place_rigid_with(plant, by, int(n));
    }
}

void put_pins_at_node(Plant& plant, int chain_node) {
    constexpr double NEAR = 1e-9;  // distance over the plant's size [-]
    VecX places = plant.input.pin_target;
    for (size_t n = 0; n < plant.input.pinned.size(); n++) {
        if (!plant.input.pinned[n] || chain_node_that_holds(plant, n) != chain_node) continue;
        point(places, int(n)) = place_rigid_with(plant, chain_node, int(n));
    }
    const double way = (places - plant.input.pin_target).lpNorm<Eigen::Infinity>();
    plant.input.pins_are_own |= !(way < NEAR * double(plant.size));
    plant.input.pin_target = places;
}

static void pin_chain(Plant& plant) {
    std::fill(plant.state.motion.pinned.begin(), plant.state.motion.pinned.end(), uint8_t(0));
    plant.input.pin_springs.clear();
    std::map<int, PinGroup> groups;  // by chain node
    PinGroup ground;                 // all nodes that the plant stands on
    for (size_t n = 0; n < plant.input.pinned.size(); n++) {
        if (!plant.input.pinned[n]) continue;
        add_to_group(plant, int(n), groups[chain_node_that_holds(plant, n)]);
        if (plant.input.foot->pinned[n]) add_to_group(plant, int(n), ground);
    }
    // A root with too few pinned nodes stands as the ground does.
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const double top = plant.model->surface.lower().y() + plant.input.foot->root_height;
    const auto is_root = [&](size_t i) {
        return nodes[i].parent < 0 && (plant.input.stands_on_roots || nodes[i].position.y() < top);
    };
    if (!ground.nodes.empty())
        for (size_t i = 0; i < nodes.size(); i++)
            if (is_root(i)) groups[int(i)];
    for (const auto& [chain_node, group] : groups) {
        if (support_of(plant, chain_node)) continue;
        if (hold_chain_node(plant, chain_node, group)) continue;
        const bool stands = nodes[size_t(chain_node)].parent < 0 && (group.stands || group.nodes.empty());
        if (stands && hold_chain_node(plant, chain_node, ground)) continue;
        for (size_t k = 0; k < group.nodes.size(); k++)
            plant.input.pin_springs.push_back(
                {plant.follow->attachments[size_t(group.nodes[k])], group.to[k], pin_stiffness(plant)});
    }
    hold_supported(supports_of(plant), plant.state.motion);
}

// Compares rotation vectors on the same side of the half turn.
bool is_where_held(const Motion& motion) {
    const int count = int(motion.pinned.size());
    int i = next_pinned(motion, 0);
    while (i < count && point(motion.x, i) == point(motion.pin_target, i)) i = next_pinned(motion, i + 1);
    return i == count;
}

bool is_carried(const Motion& motion, const VecX& x, const VecX& v) {
    const int count = int(motion.pinned.size());
    int i = next_pinned(motion, 0);
    while (i < count && point(motion.pin_target, i) == point(x, i) && point(v, i) == Vec3::Zero())
        i = next_pinned(motion, i + 1);
    return i < count;
}

void apply_pins(Plant& plant) {
    FROND_ASSERT(plant.input.pinned.size() == size_t(node_count_of(plant)));
    if (plant.follow) {
        if (plant.input.pins_changed || !is_where_held(plant.state.motion)) pin_chain(plant);
    } else if (plant.input.pins_changed) {
        plant.input.pin_springs.clear();
        plant.state.motion.pinned = plant.input.pinned;
        plant.state.motion.pin_target = plant.input.pin_target;
    }
    plant.input.pins_changed = false;
}

// Far from its target a spring pulls where the derivative of its place no longer points, and by its stiffness every
// step would end as far off on another side, for ever.
bool lead_pin_springs(Plant& plant) {
    if (plant.input.pin_springs.empty()) return false;
    constexpr double NEAR = 0.5;  // way along which the derivative holds, over the mean length of a capsule [-]
    const Chain& chain = plant.model->chain;
    const double capsules = double(chain.nodes.size()) - chain.root_count();
    if (!(capsules > 0)) return false;
    bool any = false;
    const double most = NEAR * chain.length() / capsules;
    for (Spring& spring : plant.input.pin_springs) {
        const Vec3 place = attachment_place(spring.attachment, plant.state.motion.x), way = spring.target - place;
        if (!(way.norm() > most)) continue;
        spring.target = place + most / way.norm() * way;
        plant.input.pins_changed = any = true;
    }
    return any;
}

double miss_of_pins(const Plant& plant) {
    if (plant.input.pinned.empty()) return 0;
    const VecX& places = cage_places(plant);
    double farthest = 0;
    for (size_t n = 0; n < plant.input.pinned.size(); ++n)
        if (plant.input.pinned[n])
            farthest = std::max(farthest, (point(plant.input.pin_target, int(n)) - point(places, int(n))).norm());
    return farthest;
}

double way_of_pins(const Plant& plant) {
    return plant.input.pins_changed ? miss_of_pins(plant) : 0;
}

}  // namespace frond
