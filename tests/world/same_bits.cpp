// Plants give the same bits on every processor, by any compiler and with any number of threads: state hashes after ten
// seconds, recorded once.
// Where results are changed on purpose, take the numbers that a failure reports.
#include <LinearMath/btScalar.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "core/lanes.hpp"
#include "frond/frond.h"
#include "support/must.hpp"

namespace same_bits_tests {

using frond::lanes_of_processor;
using frond::most_lanes;
using frond::test::must;

constexpr double H = 1.0 / 60;
constexpr int STEPS = 600;

struct Row {
    const char* name;
    const char* file;  // corn or a URDF tree of links
    frond_mechanics mechanics;
    int plants;
    double apart;  // [m]
    bool has_ball;
    frond_wind_profile profile;
    double wind;                    // [m/s]
    uint64_t hash, hash_in_double;  // with Bullet in single and in double precision
};
const Row ROWS[] = {
    {"tets", "corn/corn.obj", FROND_MECHANICS_TET_COROTATIONAL, 1, 0, false, FROND_WIND_PROFILE_LOG, 6,
     0x5301f0d090afe0e9, 0x6446932b6c02dc95},
    {"rods", "corn/corn.obj", FROND_MECHANICS_ROD, 1, 0, false, FROND_WIND_PROFILE_POWER, 6, 0xdeb4bc9e622bd0aa,
     0xcb248ce5088c1b3c},
    {"neo_hookean", "wheat/wheat.obj", FROND_MECHANICS_TET_NEOHOOKEAN, 1, 0, false, FROND_WIND_PROFILE_LOG, 3,
     0xfc7d5696de7b3325, 0x05399eb4fa997a71},
    {"twig", "urdf/sapling.urdf", FROND_MECHANICS_ROD, 1, 0, false, FROND_WIND_PROFILE_LOG, 9, 0x4100bf23ef5449c8,
     0xcfee5dc6af2f64c2},
    {"ball_on_tets", "corn/corn.obj", FROND_MECHANICS_TET_COROTATIONAL, 1, 0, true, FROND_WIND_PROFILE_LOG, 0,
     0xcba4221c4cedecd7, 0x324e9e7e64d63cec},
    {"ball_on_rods", "corn/corn.obj", FROND_MECHANICS_ROD, 1, 0, true, FROND_WIND_PROFILE_LOG, 0, 0x38964407d6f270ea,
     0x9b6126e35779a645},
    {"pair", "corn/corn.obj", FROND_MECHANICS_ROD, 2, 0.25, false, FROND_WIND_PROFILE_LOG, 6, 0x2edd5e6d01f72430,
     0x8a3c92ce88687fc5},
    {"field", "wheat/wheat.obj", FROND_MECHANICS_ROD, 9, 1.5, false, FROND_WIND_PROFILE_UNIFORM, 4, 0xf86aeb9345289c13,
     0xc3e6221a6f006655},
};

// A host's threads. A browser's page has one, and takes the jobs from the last to the first.
void parallel_for(int count, frond_job_fn* job, void* data, void* user) {
#ifdef __EMSCRIPTEN__
    (void)user;
    for (int i = count; i-- > 0;) job(data, i);
#else
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) job(data, i);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < *static_cast<const int*>(user); i++) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
#endif
}

frond_world make_world(const Row& row, frond_model model, int* threads) {
    frond_world_def world_def = frond_default_world_def();
    if (*threads > 1) {
        world_def.parallel_for = parallel_for;
        world_def.parallel_user = threads;
    }
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    for (int i = 0; i < row.plants; i++) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = row.mechanics;
        def.position = {row.apart * (i % 3), 0, row.apart * (i / 3)};
        frond_plant plant = {};
        must(frond_plant_create(world, model, &def, &plant));
    }
    if (row.has_ball) {
        frond_rigid_def ground = frond_default_rigid_def(), ball = frond_default_rigid_def();
        frond_rigid rigid = {};
        ground.shape = FROND_SHAPE_PLANE;
        must(frond_rigid_create(world, &ground, &rigid));
        ball.size.x = 0.11;
        ball.mass = 0.43;
        ball.state.position = {-1.7, 1.0, 0.03};
        ball.state.velocity = {7, 1.2, 0};
        must(frond_rigid_create(world, &ball, &rigid));
    }
    frond_wind_def wind = frond_default_wind_def();
    wind.profile = row.profile;
    wind.velocity = {row.wind, 0, 0};
    must(frond_world_set_wind(world, &wind));
    return world;
}

// Steps a scene, and compares its bits with the recorded ones.
void expect_bits(const Row& row, int threads) {
    const frond_model_def model_def = frond_default_model_def();
    frond_model model = {};
    must(frond_model_load((std::string(FROND_SOURCE_DIR "/models/") + row.file).c_str(), &model_def, &model));
    const frond_world world = make_world(row, model, &threads);
    int contacts = 0;
    for (int step = 0; step < STEPS; step++) {
        must(frond_world_step(world, H));
        frond_report report = {};
        must(frond_world_get_report(world, &report));
        contacts += report.contact_count + report.plant_contact_count;
    }
    uint64_t hash = 0;
    must(frond_world_get_state_hash(world, &hash));
    EXPECT_EQ(contacts > 0, row.has_ball || row.plants == 2);
    char both[64];
    std::snprintf(both, sizeof both, "now 0x%016llx", (unsigned long long)hash);
    EXPECT_EQ(hash, sizeof(btScalar) == sizeof(double) ? row.hash_in_double : row.hash) << both;
    frond_world_destroy(world);
    frond_model_destroy(model);
}

class SameBits : public ::testing::TestWithParam<Row> {
protected:
    void TearDown() override { most_lanes() = lanes_of_processor(); }
};

TEST_P(SameBits, AreThereAfterTenSeconds) {
    expect_bits(GetParam(), 1);
}

// On x86-64 the registers of older processors: of SSE2, and of AVX2.
TEST_P(SameBits, AreThereInNarrowerLanes) {
    for (int lanes = 2; lanes < lanes_of_processor(); lanes *= 2) {
        SCOPED_TRACE(lanes);
        most_lanes() = lanes;
        expect_bits(GetParam(), 1);
    }
}

// A lone plant is one job.
TEST(SameBitsOfSeveral, AreThereWithTwoToFourThreads) {
    for (const Row& row : ROWS)
        for (int threads = 2; row.plants > 1 && threads <= 4; threads++) {
            SCOPED_TRACE(std::string(row.name) + " " + std::to_string(threads));
            expect_bits(row, threads);
        }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, ::testing::ValuesIn(ROWS),
                         [](const ::testing::TestParamInfo<Row>& info) { return std::string(info.param.name); });

}  // namespace same_bits_tests
