// In: places of plants and the viewer, and measured step times. Out: the detail of each plant that is awake.
//
// Distances decide, with hysteresis. With a budget the nearest plants are planned first, each with its recently
// measured time, until the budget is used up; all farther ones are modal. The planned time follows the measured one,
// quickly down and slowly up, so that steps are too long once or twice at most when a crowd of plants comes near.
#include <algorithm>
#include <cmath>

#include "world/convert.hpp"
#include "world/trouble.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns whether forces, grabs, bonds, fragments or pins other than the model's roots require a plant to be simulated.
bool is_used_by_host(const World& world, const PlantBody& body) {
    return !sways_on_its_roots(*body.plant) ||
           std::any_of(world.bonds.begin(), world.bonds.end(), [&](const Bond& bond) { return bond.plant == &body; });
}

double distance_of(const World& world, const PlantBody& body) {
    const Detail& detail = *world.detail;
    if (!detail.has_viewer) return 0;
    // The middle of its capsules as modelled.
    btVector3 lower, upper;
    body.hull->rest->btCompoundShape::getAabb(btTransform::getIdentity(), lower, upper);
    const Vec3 middle = body.plant->to_world(0.5 * (from_bullet(lower) + from_bullet(upper)));
    double distance = (middle - detail.viewer).norm();
    if (detail.def.by_size) distance /= std::max(double(body.plant->size), 1e-9);
    if (detail.def.distance) distance = detail.def.distance(body.handle, distance, detail.def.user);
    return distance > 0 && std::isfinite(distance) ? distance : 0;
}

frond_detail wanted_at(const frond_detail_def& def, double distance, frond_detail now) {
    const double from[] = {def.rod_from, def.modal_from, def.still_from};
    int wanted = 0;
    while (wanted < 3 && distance >= from[wanted] * (int(now) > wanted ? 1 - def.hysteresis : 1)) wanted++;
    return frond_detail(wanted);
}

bool is_simulated(frond_detail detail) {
    return detail <= FROND_DETAIL_ROD;
}

frond_mechanics mechanics_for(const PlantBody& body, frond_detail detail) {
    const frond_mechanics own = body.level.own;
    return detail == FROND_DETAIL_FULL || mechanics(own).moves_chain ? own : FROND_MECHANICS_ROD;
}

// Returns whether a plant has this detail. After sleep it has no modal motion, whatever it had before.
bool is_given(const PlantBody& body, frond_detail detail) {
    const Plant& plant = *body.plant;
    return is_simulated(detail) == !plant.state.modal && plant.which == mechanics_for(body, detail);
}

// Changes the plant's detail, from its present shape and motion.
void give(PlantBody& body, frond_detail wanted) {
    Plant& plant = *body.plant;
    Level& level = body.level;
    if (!is_given(body, wanted)) note_of_plant(*body.world, body, FROND_TROUBLE_CHANGED_DETAIL);
    if (is_simulated(wanted)) end_modal(plant);
    set_mechanics(plant, mechanics_for(body, wanted), true);
    if (!is_simulated(wanted)) {
        begin_modal(plant);
        plant.state.modal->comes_to_rest = wanted == FROND_DETAIL_STILL;
        plant.state.modal->fresh = true;
    }
    if (is_simulated(wanted) != is_simulated(level.now)) level.pending = level.ms = 0;
    body.rest.places.resize(0);
    body.rest.still = 0;
    level.now = wanted;
}

// Estimates a plant's time per substep in a detail [ms].
double cost_of(const Detail& detail, const PlantBody& body, frond_detail wanted) {
    const double ms = wanted == body.level.now && body.level.ms > 0 ? double(body.level.ms) : detail.ms_of[int(wanted)];
    return ms / body.level.every;
}

// Returns the detail that the budget allows; `left` is the time not yet planned [ms].
frond_detail affordable(const Detail& detail, const PlantBody& body, frond_detail wanted, double& left) {
    constexpr double KEEP = 0.7;  // share of the time left that a plant may take when it gets more detail [-]
    for (; is_simulated(wanted); wanted = frond_detail(wanted + 1)) {
        const double cost = cost_of(detail, body, wanted), room = wanted >= body.level.now ? left : KEEP * left;
        if (cost > room) continue;
        left -= cost;
        return wanted;
    }
    return wanted;
}

}  // namespace

void set_detail(World& world, const frond_detail_def* def) {
    for (PlantBody* body : world.awake) {
        if (!def) give(*body, FROND_DETAIL_FULL);
        body->level.every = 1;
    }
    if (!def) {
        for (const auto& body : world.bodies) body->level.now = FROND_DETAIL_FULL;
        world.detail = nullptr;
        return;
    }
    if (!world.detail) world.detail = std::make_unique<Detail>();
    world.detail->def = *def;
}

void end_sway(PlantBody& body) {
    end_modal(*body.plant);
    body.level.every = 1;
    if (!body.world->detail) give(body, FROND_DETAIL_FULL);
}

void disturb(PlantBody& body) {
    constexpr double WHILE = 0.5;  // [s]
    body.level.disturbed = body.world->time + WHILE;
}

frond_detail detail_of(const World& world, const PlantBody& body) {
    if (!world.detail || !body.rest.asleep) return body.level.now;
    return wanted_at(world.detail->def, distance_of(world, body), body.level.now);
}

bool is_still(const World& world, const PlantBody& body) {
    return world.detail && detail_of(world, body) == FROND_DETAIL_STILL && !is_used_by_host(world, body);
}

void choose_details(World& world) {
    if (!world.detail) return;
    const Detail& detail = *world.detail;
    const frond_detail_def& def = detail.def;
    constexpr double SAFE = 0.75;  // share of the budget that is planned; the rest is a margin [-]
    constexpr int MOST = 2;        // plants that change between cage and chain in a substep with a budget
    std::vector<PlantBody*> order = world.awake;
    for (PlantBody* body : order) body->level.distance = float(distance_of(world, *body));
    const bool is_limited = def.budget > 0;
    if (is_limited)
        std::stable_sort(order.begin(), order.end(),
                         [](const PlantBody* a, const PlantBody* b) { return a->level.distance < b->level.distance; });
    double left = SAFE * detail.room * def.budget / detail.overhead;
    int handed_over = 0;
    for (PlantBody* body : order) {
        Level& level = body->level;
        frond_detail wanted = wanted_at(def, level.distance, level.now);
        const bool held = is_used_by_host(world, *body);
        const bool is_disturbed = world.time < level.disturbed;
        if (held || (is_disturbed && wanted == FROND_DETAIL_MODAL)) wanted = std::min(wanted, FROND_DETAIL_ROD);
        const double half_from = def.half_from * (level.every > 1 ? 1 - def.hysteresis : 1);
        level.every = is_simulated(wanted) && level.distance >= half_from && !is_disturbed ? 2 : 1;
        if (is_limited && !held) wanted = affordable(detail, *body, wanted, left);
        if (wanted == level.now && is_given(*body, wanted)) continue;
        const bool goes_over = body->plant->which != mechanics_for(*body, wanted);
        if (is_limited && goes_over && ++handed_over > MOST) continue;
        give(*body, wanted);
    }
}

void learn_times(World& world) {
    if (!world.detail) return;
    Detail& detail = *world.detail;
    constexpr double LEAST = 0.05;                     // shortest time that is significant [ms]
    constexpr double SLOWLY = 0.1, MOST_OVERHEAD = 3;  // [-]
    // UP is so slow that about one step in fifty exceeds the budget [-].
    constexpr double DOWN = 0.8, UP = 1.005, FULL = 0.8, LEAST_ROOM = 0.02, MOST_ROOM = 3;
    double sum[2] = {}, count[2] = {};
    for (const PlantBody* body : world.awake) {
        if (!is_simulated(body->level.now) || !body->level.is_due) continue;
        sum[int(body->level.now)] += double(body->level.ms);
        count[int(body->level.now)]++;
    }
    for (size_t k = 0; k < 2; k++)
        if (count[k] > 0) detail.ms_of[k] += SLOWLY * (sum[k] / count[k] - detail.ms_of[k]);
    const double plants = sum[0] + sum[1], ms = world.profile.ms_step;
    if (plants > LEAST) detail.overhead += SLOWLY * (std::clamp(ms / plants, 1.0, MOST_OVERHEAD) - detail.overhead);
    if (ms > detail.def.budget)
        detail.room = std::max(DOWN * detail.room, LEAST_ROOM);
    else if (ms < FULL * detail.def.budget)
        detail.room = std::min(UP * detail.room, MOST_ROOM);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
