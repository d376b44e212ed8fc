// A substep of all plants of a world, inside Bullet's own. Its parts have zones in Bullet's profiler.
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <cmath>

#include "contact/find_contacts.hpp"
#include "contact/foresee.hpp"
#include "contact/respond_to_contacts.hpp"
#include "core/assert.hpp"
#include "core/timer.hpp"
#include "plant/plant_step.hpp"
#include "step/report.hpp"
#include "step/step_plants.hpp"
#include "step/touch.hpp"
#include "world/detection.hpp"
#include "world/fragments.hpp"
#include "world/link_loads.hpp"
#include "world/robot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Numbers the plants that are awake, in the order in which they came into the world.
void call_roll(World& world) {
    for (PlantBody* body : world.taking_part) body->number = -1;
    world.taking_part.clear();
    std::sort(world.awake.begin(), world.awake.end(),
              [](const PlantBody* a, const PlantBody* b) { return a->index < b->index; });
    for (PlantBody* body : world.awake) number_of(world, *body);
}

// Does the part of a plant's step that has to be done by one thread.
void settle(World& world, PlantBody& body, btCollisionWorld& collision_world) {
    frond_report& report = world.report;
    report.detail_count[body.level.now]++;
    if (!body.level.is_due) return;
    add_to_report(world, body);
    if (!body.plant->state.modal && body.plant->input.effects & world.effects & FROND_EFFECT_BREAKING) {
        const Timer timer;
        report.broken_count += break_overloaded(world, body);
        move_capsules(body);
        add_effect(world, FROND_EFFECT_BREAKING, timer.ms());
    }
    collision_world.updateSingleAabb(&body);
    world.profile.ms_capsules += double(body.level.ms_capsules);
    body.level.pending = 0;
    if (!world.own) clear_user_force(*body.plant);
}

Surroundings begin_step(World& world, btCollisionWorld& collision_world, double h) {
    world.substep++;
    world.substep_length = h;
    end_hold(world.gravity_ahead, collision_world);
    world.report = {};
    world.profile = {};
    Surroundings surroundings;
    surroundings.gravity = gravity_of(world);
    surroundings.effects = world.effects;
    if (world.wind) pass_time(*world.wind, h);
    surroundings.wind = world.wind.get();
    surroundings.time = world.time + h;
    return surroundings;
}

void carry_what_came_off(World& world, double h) {
    for (PlantBody* body : world.awake) {
        if (body->fragment_bodies.empty()) continue;
        carry_fragments(*body);
        if (body->plant->input.effects & world.effects & FROND_EFFECT_USER_FORCE) pull_fragments(*body, h);
    }
}

void handle_contacts(World& world, double h) {
    const Timer timer;
    let_go_of_gone(world);
    sweep_what_whipped(world, h);
    frond_report& report = world.report;
    const bool any_watched = std::any_of(world.awake.begin(), world.awake.end(),
                                         [](const PlantBody* body) { return body->plant->step.is_watched; });
    if (!world.contacts.empty() || !world.plant_contacts.empty() || !world.bonds.empty() || any_watched) {
        BT_PROFILE("frond respond");
        respond_to_contacts(world, h);
        report.effects_run |=
            world.effects & (FROND_EFFECT_FRICTION | (world.contacts.empty() ? 0 : FROND_EFFECT_TWO_WAY));
    }
    world.profile.ms_response = timer.ms();
    report.contact_count = int(world.contacts.size());
    report.plant_contact_count = int(world.plant_contacts.size());
    report.awake_count = int(world.awake.size());
}

void take_step(World& world, btCollisionWorld& collision_world, double h) {
    FROND_ASSERT(h > 0);
    const Timer step_timer;
    const Surroundings surroundings = begin_step(world, collision_world, h);
    if (world.ledger) count_calls(world);
    call_roll(world);
    carry_what_came_off(world, h);
    take_back_from_links(world);
    find_touches(world, h);
    call_roll(world);
    note_touches(world);
    choose_details(world);
    mark_touched(world);
    if (world.ledger) begin_work(world);
    {
        BT_PROFILE("frond solve");
        step_plants(world, surroundings, h);
    }
    handle_contacts(world, h);
    finish_touched(world, surroundings);
    if (world.ledger) count_work(world);
    {
        BT_PROFILE("frond settle");
        const Timer timer;
        for (PlantBody* body : world.awake) settle(world, *body, collision_world);
        world.profile.ms_capsules += timer.ms();
    }
    if (world.ledger) count_what_came_off(world);
    note_touching(world);
    if (world.sleep_distance > 0) put_to_sleep(world);
    compress_looked_at(world);
    lend_link_loads(world);
    limit_motors(world, h);
    world.time += h;
    world.profile.ms_step = step_timer.ms();
    learn_times(world);
}

// Aborts a step that cannot be completed: plants that have not completed it are put back to its start. Bullet has moved
// its bodies and will not reach the end of stepSimulation, so the forces on them are cleared here.
void break_off_step(World& world) {
    world.bullet->clearForces();
    for (PlantBody* body : world.awake) {
        drop_step(*body->plant);
        body->level.pending = 0;
    }
}

}  // namespace

void World::updateAction(btCollisionWorld* collision_world, btScalar step) {
    const double h = double(step);
    put_back_children(lacking);
    if (!(h > 0) || !std::isfinite(h)) return;
    BT_PROFILE("frond");
    is_stepping = true;
    const auto end = [&] {
        end_detection(*bullet);
        is_stepping = false;
    };
    try {
        take_step(*this, *collision_world, h);
    } catch (...) {
        break_off_step(*this);
        end();
        throw;
    }
    end();
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
