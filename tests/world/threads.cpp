// Threads: the host's own, for the steps of plants; the same bits come out for any number of them.
#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

#include "frond/frond.h"
#include "support/stems.hpp"

namespace {

constexpr double H = 1.0 / 60;

void must(frond_result result) {
    ASSERT_EQ(result, FROND_OK) << frond_last_error();
}

// A game's job system, as simple as one can be.
struct Team {
    int size;
    int calls = 0;
    std::atomic<int> jobs{0};
};

void parallel_for(int count, frond_job_fn* job, void* data, void* user) {
    Team& team = *static_cast<Team*>(user);
    team.calls++;
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) {
            job(data, i);
            team.jobs++;
        }
    };
    std::vector<std::thread> others;
    for (int i = 1; i < team.size; i++) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
}

void field_of_wind(const frond_vec3* points, int count, double time, frond_vec3* velocities, void*) {
    for (int i = 0; i < count; i++) velocities[i] = {3 + points[i].x + time, 0, points[i].y};
}

// Twelve plants in every mechanics, some in each other, in wind; a ball is thrown among them.
uint64_t hash_with(Team* team) {
    frond_world_def def = frond_default_world_def();
    if (team) {
        def.parallel_for = parallel_for;
        def.parallel_user = team;
    }
    frond_world world = {};
    EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    for (int i = 0; i < 12; i++) {
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = i % 3 ? FROND_ROD : FROND_TET_COROTATIONAL;
        plant_def.position = {0.25 * (i % 4), 0, 0.3 * (i / 4)};
        frond_plant plant = {};
        EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK);
    }
    frond_rigid_def ball = frond_default_rigid_def();
    ball.mass = 0.4;
    ball.state.position = {-0.5, 0.4, 0.1};
    ball.state.velocity = {4, 1, 0};
    frond_rigid rigid = {};
    EXPECT_EQ(frond_rigid_create(world, &ball, &rigid), FROND_OK);
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {4, 0, 0};
    EXPECT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
    EXPECT_EQ(frond_world_set_wind_field(world, field_of_wind, nullptr), FROND_OK);
    int contacts = 0;
    for (int i = 0; i < 60; i++) {
        must(frond_world_step(world, H));
        frond_report report = {};
        must(frond_world_get_report(world, &report));
        contacts += report.contact_count;
    }
    EXPECT_GT(contacts, 0);
    uint64_t hash = 0;
    must(frond_world_get_state_hash(world, &hash));
    frond_world_destroy(world);
    frond_model_destroy(model);
    return hash;
}

TEST(Threads, OfAnyNumberGiveTheSameBits) {
    const uint64_t alone = hash_with(nullptr);
    for (const int size : {1, 2, 4}) {
        Team team = {size};
        EXPECT_EQ(hash_with(&team), alone) << size << " threads";
        EXPECT_GE(team.calls, 60);
        EXPECT_GT(team.jobs, 60 * 6);
    }
}

}  // namespace
