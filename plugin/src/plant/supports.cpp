// In: a plant whose mechanics move the chain, and how some of its nodes are held. Out: which blocks of its motion are
// pinned as a whole, and which rotations are guided.
#include "plant/supports.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "mechanics/rotation.hpp"
#include "plant/pins.hpp"
#include "solve/guides.hpp"

namespace frond {

static bool is_guide(const Support& support) {
    return support.held_turns == FROND_HELD_TURNS_ABOUT_AXIS || support.held_turns == FROND_HELD_TURNS_ACROSS_AXIS;
}

static Guide guide_by(const Support& support) {
    const bool is_hinge = support.held_turns == FROND_HELD_TURNS_ACROSS_AXIS;
    return {2 * support.chain_node + 1, is_hinge, support.axis, support.turn};
}

static const Supports& all_of(const Plant& plant) {
    static const Supports NONE;
    return plant.input.supports ? *plant.input.supports : NONE;
}
const std::vector<Support>& supports_of(const Plant& plant) {
    return all_of(plant).list;
}
const std::vector<Guide>& guides_of(const Plant& plant) {
    return all_of(plant).guides;
}

// A plant that has none keeps no list: a sleeper is to be small.
void give_supports(Plant& plant, std::vector<Support> list) {
    Supports supports;
    for (const Support& support : list)
        if (is_guide(support)) supports.guides.push_back(guide_by(support));
    supports.list = std::move(list);
    plant.input.pins_changed = true;
    plant.input.supports = supports.list.empty() ? nullptr : std::make_unique<const Supports>(std::move(supports));
    plant.step.loads->guides = &guides_of(plant);
}

const Support* support_of(const Plant& plant, int chain_node) {
    for (const Support& support : supports_of(plant))
        if (support.chain_node == chain_node) return &support;
    return nullptr;
}

// Steps go on without history and with what is held at rest.
static void hold_anew(Plant& plant) {
    Motion& motion = plant.state.motion;
    motion.history.valid = motion.history.shaken = false;
    plant.state.stepped_by = 0;
    apply_pins(plant);
    const int count = int(motion.pinned.size());
    for (int i = next_pinned(motion, 0); i < count; i = next_pinned(motion, i + 1)) {
        const bool stays = point(motion.pin_target, i) == point(motion.x, i);
        if (stays && support_of(plant, i / 2)) point(motion.v, i).setZero();
    }
    for (const Guide& guide : guides_of(plant)) {
        auto rate = point(motion.v, guide.node);
        rate -= Vec3(held_part(guide, point(motion.x, guide.node)) * rate);
    }
}

// Returns all supports that are not as `is_gone` says.
template <class F>
static std::vector<Support> supports_but(const Plant& plant, const F& is_gone) {
    std::vector<Support> left;
    for (const Support& support : supports_of(plant))
        if (!is_gone(support)) left.push_back(support);
    return left;
}

static std::vector<Support> supports_of_others(const Plant& plant, int chain_node) {
    return supports_but(plant, [&](const Support& support) { return support.chain_node == chain_node; });
}

void set_support(Plant& plant, int chain_node, bool holds_place, frond_held_turns held_turns, const Vec3& axis) {
    end_modal(plant);
    FROND_ASSERT(plant.follow && !plant.state.is_compressed);
    const VecX& x = plant.state.motion.x;
    std::vector<Support> all = supports_of_others(plant, chain_node);
    all.push_back({chain_node, holds_place, held_turns, axis, point(x, 2 * chain_node), point(x, 2 * chain_node + 1)});
    give_supports(plant, std::move(all));
    hold_anew(plant);
}

void remove_support(Plant& plant, int chain_node) {
    if (!support_of(plant, chain_node)) return;
    give_supports(plant, supports_of_others(plant, chain_node));
    put_pins_at_node(plant, chain_node);
    hold_anew(plant);
}

void hold_supported(const std::vector<Support>& supports, Motion& motion) {
    for (const Support& support : supports) {
        const int place = 2 * support.chain_node, turn = place + 1;
        motion.pinned[size_t(place)] = support.holds_place;
        motion.pinned[size_t(turn)] = support.held_turns == FROND_HELD_TURNS_ALL;
        if (support.holds_place) point(motion.pin_target, place) = support.place;
        if (support.held_turns == FROND_HELD_TURNS_ALL)
            point(motion.pin_target, turn) = wound_as(Vec3(point(motion.x, turn)), support.turn);
    }
}

bool hold_several_places(const Plant& plant) {
    const auto holds_place = [](const Support& support) { return support.holds_place; };
    const std::vector<Support>& all = supports_of(plant);
    if (std::none_of(all.begin(), all.end(), holds_place)) return false;
    const std::vector<uint8_t>& pinned = plant.state.motion.pinned;
    int places = 0;
    for (size_t i = 0; i < pinned.size(); i += 2) places += pinned[i];
    return places > 1;
}

bool need_several_solves(const Plant& plant) {
    const std::vector<Guide>& guides = guides_of(plant);
    const bool turns_in_fork =
        std::any_of(guides.begin(), guides.end(), [](const Guide& guide) { return !guide.is_hinge; });
    return hold_several_places(plant) ||
           (turns_in_fork && plant.input.settings.integrator == FROND_INTEGRATOR_IMPLICIT_EULER);
}

// A turn that the guide allows leaves it as it is: what a fork allows depends on where it was made.
void carry_supports(Plant& plant) {
    constexpr double NEAR = 1e-9;  // [rad]
    std::vector<Support> all = supports_of(plant);
    for (Support& support : all) {
        const Vec3 turn = point(plant.state.motion.x, 2 * support.chain_node + 1);
        support.place = point(plant.state.motion.x, 2 * support.chain_node);
        if (!is_guide(support) || !((guided(guide_by(support), turn) - turn).norm() < NEAR)) support.turn = turn;
    }
    give_supports(plant, std::move(all));
}

void drop_lost_supports(Plant& plant) {
    give_supports(plant, supports_but(plant, [&](const Support& support) {
                      return fragment_of_chain_node(plant, size_t(support.chain_node)) != nullptr;
                  }));
}

}  // namespace frond
