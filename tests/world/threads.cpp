// Threads: the host's own, for the steps of plants; results are the same bits for any number of them.
#include <LinearMath/btThreads.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>
#include <set>
#include <thread>
#include <vector>

#include "frond/frond.h"
#include "support/must.hpp"
#include "support/stems.hpp"

namespace threads_tests {

using frond::test::must;

constexpr double H = 1.0 / 60;

// A game's job system, reduced to a minimum.
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

// Makes a world with the threads of a team, if there is one.
frond_world make_world(frond_world_def def, Team* team) {
    if (team) {
        def.parallel_for = parallel_for;
        def.parallel_user = team;
    }
    frond_world world = {};
    EXPECT_EQ(frond_world_create(&def, &world), FROND_OK);
    return world;
}

// Twelve plants, rods and cages, some overlapping, in wind; a ball is thrown among them. Plants of one kind without
// contacts share jobs.
uint64_t hash_with(Team* team) {
    const frond_world world = make_world(frond_default_world_def(), team);
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    for (int i = 0; i < 12; i++) {
        frond_plant_def plant_def = frond_default_plant_def();
        plant_def.mechanics = i % 3 ? FROND_MECHANICS_ROD : FROND_MECHANICS_TET_COROTATIONAL;
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
        EXPECT_GT(team.jobs, 60 * 4);
    }
}

// Runs out of memory after half of the jobs, in one call.
struct PoorTeam {
    int fails_in, calls = 0;
};
void poor_parallel_for(int count, frond_job_fn* job, void* data, void* user) {
    PoorTeam& team = *static_cast<PoorTeam*>(user);
    const bool fails = ++team.calls == team.fails_in;
    for (int i = 0; i < (fails ? count / 2 : count); i++) job(data, i);
    if (fails) throw std::bad_alloc();
}

// Three pairs of plants that lean on each other, and a ball that falls beside them.
struct Leaning {
    frond_world world = {};
    frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    std::vector<frond_plant> plants = std::vector<frond_plant>(6);
    frond_rigid ball = {};
    explicit Leaning(PoorTeam& team) {
        frond_world_def def = frond_default_world_def();
        def.parallel_for = poor_parallel_for;
        def.parallel_user = &team;
        must(frond_world_create(&def, &world));
        for (size_t i = 0; i < plants.size(); i++) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = i % 3 ? FROND_MECHANICS_ROD : FROND_MECHANICS_TET_COROTATIONAL;
            plant_def.position = {double(i / 2) + 0.03 * double(i % 2), 0, 0};
            must(frond_plant_create(world, model, &plant_def, &plants[i]));
        }
        frond_rigid_def ball_def = frond_default_rigid_def();
        ball_def.mass = 0.1;
        ball_def.state.position = {0, 100, 3};
        must(frond_rigid_create(world, &ball_def, &ball));
    }
    ~Leaning() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    double height() const {
        frond_rigid_state state;
        must(frond_rigid_get_state(ball, &state));
        return state.position.y;
    }
    std::vector<double> places(frond_plant plant) const {
        std::vector<double> places(size_t(3 * frond_plant_get_node_count(plant)));
        must(frond_plant_get_state(plant, places.data(), nullptr, int(places.size() / 3)));
        return places;
    }
};

// Tests both halves of a plant step. A plant that missed one continues a sixtieth of a second behind, and with friction
// comes to rest a little elsewhere.
TEST(Threads, ThatFailBreakOffOneStepAndNoMore) {
    constexpr int STEPS = 240;
    PoorTeam rich = {0};
    Leaning whole(rich);
    for (int i = 0; i < STEPS; i++) must(frond_world_step(whole.world, H));
    for (const int fails_in : {21, 22}) {
        PoorTeam poor = {fails_in};
        Leaning broken(poor);
        int failed = 0;
        for (int i = 0; i < STEPS; i++) {
            const frond_result result = frond_world_step(broken.world, H);
            failed += result != FROND_OK;
            if (result != FROND_OK) {
                EXPECT_EQ(result, FROND_RESULT_OUT_OF_MEMORY);
            }
        }
        EXPECT_EQ(failed, 1);
        EXPECT_NEAR(broken.height(), whole.height(), 1e-9);
        for (size_t k = 0; k < whole.plants.size(); k++) {
            const std::vector<double> a = whole.places(whole.plants[k]), b = broken.places(broken.plants[k]);
            for (size_t i = 0; i < a.size(); i++) ASSERT_NEAR(a[i], b[i], 0.01) << fails_in << ", plant " << k;
        }
    }
}

// A task scheduler of the host's, as it would set for Bullet.
struct Scheduler : btITaskScheduler {
    Team team;
    int grain = 0;
    explicit Scheduler(int size) : btITaskScheduler("of the test"), team{size} {}
    int getMaxNumThreads() const override { return team.size; }
    int getNumThreads() const override { return team.size; }
    void setNumThreads(int) override {}
    void parallelFor(int begin, int end, int grain_size, const btIParallelForBody& body) override {
        grain = grain_size;
        struct Range {
            int begin, end, grain;
            const btIParallelForBody& body;
        } range = {begin, end, grain_size, body};
        const auto run = [](void* data, int i) {
            const Range& r = *static_cast<Range*>(data);
            r.body.forLoop(r.begin + i * r.grain, std::min(r.end, r.begin + (i + 1) * r.grain));
        };
        parallel_for((end - begin + grain_size - 1) / grain_size, run, &range, &team);
    }
    btScalar parallelSum(int begin, int end, int, const btIParallelSumBody& body) override {
        return body.sumLoop(begin, end);
    }
};

// Sets the scheduler during its lifetime.
struct WithScheduler {
    explicit WithScheduler(btITaskScheduler* scheduler) { btSetTaskScheduler(scheduler); }
    ~WithScheduler() { btSetTaskScheduler(nullptr); }
};

TEST(Threads, OfBulletsTaskSchedulerGiveTheSameBits) {
    const uint64_t alone = hash_with(nullptr);
    for (const int size : {2, 4}) {
        Scheduler scheduler(size);
        const WithScheduler set(&scheduler);
        EXPECT_EQ(hash_with(nullptr), alone) << size << " threads";
        EXPECT_GE(scheduler.team.calls, 60);
        EXPECT_GT(scheduler.team.jobs * scheduler.grain, 60 * 4);
    }
    const WithScheduler set(btGetSequentialTaskScheduler());
    EXPECT_EQ(hash_with(nullptr), alone) << "Bullet's own, of one thread";
}

// A host that gives threads to Frond itself has made its choice.
TEST(Threads, OfTheHostGoBeforeBulletsTaskScheduler) {
    Scheduler scheduler(2);
    const WithScheduler set(&scheduler);
    Team team = {2};
    hash_with(&team);
    EXPECT_GT(team.calls, 0);
    EXPECT_EQ(scheduler.team.calls, 0);
}

// Simulates pairs of plants that lean on each other with a ball beside each pair, far apart: as many contact islands.
// Returns the bits of plants and balls.
std::vector<uint64_t> hash_of_islands(Team* team, frond_response response) {
    constexpr int ISLANDS = 5;
    frond_world_def def = frond_default_world_def();
    def.response = response;
    const frond_world world = make_world(def, team);
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    std::vector<frond_rigid> balls;
    for (int i = 0; i < ISLANDS; i++) {
        for (int k = 0; k < 2; k++) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = (i + k) % 3 ? FROND_MECHANICS_ROD : FROND_MECHANICS_TET_COROTATIONAL;
            plant_def.effects |= FROND_EFFECT_SELF_CONTACT;
            plant_def.position = {3.0 * i + 0.03 * k, 0, 0};
            frond_plant plant = {};
            EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK);
        }
        frond_rigid_def ball = frond_default_rigid_def();
        ball.size = {0.05, 0, 0};
        ball.mass = 0.2;
        ball.state.position = {3.0 * i - 0.2, 0.4, 0};
        ball.state.velocity = {2, 1, 0};
        balls.push_back({});
        EXPECT_EQ(frond_rigid_create(world, &ball, &balls.back()), FROND_OK);
    }
    int with_bodies = 0, with_plants = 0;
    for (int i = 0; i < 40; i++) {
        must(frond_world_step(world, H));
        frond_report report = {};
        must(frond_world_get_report(world, &report));
        with_bodies += report.contact_count;
        with_plants += report.plant_contact_count;
    }
    EXPECT_GT(with_bodies, ISLANDS);
    EXPECT_GT(with_plants, ISLANDS);
    std::vector<uint64_t> bits(1);
    must(frond_world_get_state_hash(world, &bits[0]));
    for (const frond_rigid ball : balls) {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(ball, &state));
        for (const double value : {state.position.x, state.position.y, state.position.z, state.velocity.x,
                                   state.velocity.y, state.velocity.z}) {
            bits.emplace_back();
            std::memcpy(&bits.back(), &value, sizeof value);
        }
    }
    frond_world_destroy(world);
    frond_model_destroy(model);
    return bits;
}

// Contacts too are found and resolved by several threads, and bodies receive the same impulses.
TEST(Threads, GiveTheSameBitsToIslandsOfContacts) {
    for (const frond_response response : {FROND_RESPONSE_IMPULSE, FROND_RESPONSE_PENALTY}) {
        const std::vector<uint64_t> alone = hash_of_islands(nullptr, response);
        int calls_of_two = 0;
        for (const int size : {2, 3, 4}) {
            Team team = {size};
            EXPECT_EQ(hash_of_islands(&team, response), alone) << size << " threads";
            // Search, steps, response and the rest of the steps.
            EXPECT_GT(team.calls, 100);
            if (size == 2) calls_of_two = team.calls;
            EXPECT_EQ(team.calls, calls_of_two);
        }
    }
}

}  // namespace threads_tests
