// The energy ledger: what is given to a plant slowly, it has.
#include <cmath>
#include <functional>

#include "frond/frond_snapshot.h"
#include "support/stems.hpp"

namespace {

using Ledger = frond_energy_ledger;

double sum_of(const frond_energy& energy) {
    return energy.kinetic + energy.elastic + energy.gravity;
}

struct Accounts {
    SmallWorld small;
    Ledger begin = {};

    explicit Accounts(const frond_plant_def& def) : small(def, 1e7, FROND_REST_STANDS_AS_MODELLED) {
        step(30);
        begin = now();
    }
    Ledger now() const {
        Ledger ledger = {};
        EXPECT_EQ(frond_world_get_energy_ledger(small.world, &ledger), FROND_OK) << frond_last_error();
        return ledger;
    }
    void step(int count) {
        for (int i = 0; i < count; i++)
            ASSERT_EQ(frond_world_step(small.world, 1.0 / 120), FROND_OK) << frond_last_error();
    }
    // Does something in many steps; `share` runs to one.
    void slowly(const std::function<void(double share)>& act) {
        constexpr int STEPS = 600;
        for (int i = 1; i <= STEPS; i++) {
            act(double(i) / STEPS);
            step(1);
        }
    }
    frond_vec3 tip() const {
        frond_vec3 tip = {};
        EXPECT_EQ(frond_plant_get_tip(small.plant, &tip), FROND_OK);
        return tip;
    }
    std::vector<frond_vec3> places() const {
        std::vector<frond_vec3> x(size_t(frond_plant_get_node_count(small.plant)));
        EXPECT_EQ(frond_plant_get_state(small.plant, &x[0].x, nullptr, int(x.size())), FROND_OK);
        return x;
    }
    int highest_node() const {
        const std::vector<frond_vec3> x = places();
        int highest = 0;
        for (int i = 1; i < int(x.size()); i++)
            if (x[size_t(i)].y > x[size_t(highest)].y) highest = i;
        return highest;
    }
    double gained() const { return sum_of(now().now) - sum_of(begin.now); }
};

frond_plant_def def_with(frond_mechanics mechanics) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    return def;
}

struct LedgerOf : testing::TestWithParam<frond_mechanics> {
    Accounts accounts{def_with(GetParam())};

    // What was given went into the plant, but for a twentieth.
    void expect_given(double Ledger::*term) {
        const Ledger now = accounts.now();
        const double given = now.*term, gained = accounts.gained();
        EXPECT_GT(given, 1e-3);
        EXPECT_NEAR(given, gained, 0.05 * given);
        EXPECT_NEAR(now.dissipated, given - gained, 0.01 * given);
        for (double Ledger::*const other : {&Ledger::forces, &Ledger::grabs, &Ledger::air, &Ledger::pins,
                                            &Ledger::bodies, &Ledger::bonds, &Ledger::fragments, &Ledger::calls})
            if (other != term) {
                EXPECT_NEAR(now.*other, 0, 1e-12);
            }
    }
};
INSTANTIATE_TEST_SUITE_P(Mechanics, LedgerOf,
                         testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                         FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD,
                                         FROND_MECHANICS_SPRING_CHAIN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

TEST_P(LedgerOf, AForceThatGrowsBendsThePlant) {
    const int node = accounts.highest_node();
    accounts.slowly([&](double share) {
        ASSERT_EQ(frond_plant_add_force(accounts.small.plant, node, {0.5 * share, 0, 0}), FROND_OK);
    });
    expect_given(&Ledger::forces);
}

TEST_P(LedgerOf, AGrabPullsThePlant) {
    const frond_vec3 tip = accounts.tip();
    frond_grab grab = {};
    ASSERT_EQ(frond_grab_create(accounts.small.plant, tip, 50, &grab), FROND_OK);
    accounts.slowly([&](double share) {
        ASSERT_EQ(frond_grab_move(grab, {tip.x + 0.1 * share, tip.y, tip.z}), FROND_OK);
    });
    expect_given(&Ledger::grabs);
}

TEST_P(LedgerOf, AMovedPinBendsThePlant) {
    const int node = accounts.highest_node();
    const frond_vec3 from = accounts.places()[size_t(node)];
    ASSERT_EQ(frond_plant_pin(accounts.small.plant, node), FROND_OK);
    accounts.slowly([&](double share) {
        ASSERT_EQ(frond_plant_move_pin(accounts.small.plant, node, {from.x + 0.05 * share, from.y, from.z}), FROND_OK);
    });
    expect_given(&Ledger::pins);
}

TEST_P(LedgerOf, APlantThatIsLiftedByItsFootGainsItsWeightTimesTheHeight) {
    const std::vector<frond_vec3> from = accounts.places();
    const double height = 0.5;
    accounts.slowly([&](double share) {
        for (size_t i = 0; i < from.size(); i++)
            frond_plant_move_pin(accounts.small.plant, int(i), {from[i].x, from[i].y + height * share, from[i].z});
    });
    accounts.step(60);
    frond_model_info info = {};
    ASSERT_EQ(frond_model_get_info(accounts.small.model, &info), FROND_OK);
    EXPECT_NEAR(accounts.now().pins, 9.81 * info.mass * height, 0.02 * 9.81 * info.mass * height);
    expect_given(&Ledger::pins);
}

TEST_P(LedgerOf, ABodyThatIsMovedPressesThePlant) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_BOX;
    def.size = {0.05, 0.05, 0.3};
    def.mass = def.friction = 0;
    def.state.position = {-0.08, 0.5, 0};
    frond_rigid body = {};
    ASSERT_EQ(frond_rigid_create(accounts.small.world, &def, &body), FROND_OK);
    accounts.slowly([&](double share) {
        def.state.position.x = -0.08 + 0.1 * share;
        ASSERT_EQ(frond_rigid_set_state(body, &def.state), FROND_OK);
    });
    expect_given(&Ledger::bodies);
}

TEST_P(LedgerOf, ABodyThatIsBondedPullsThePlant) {
    const frond_vec3 tip = accounts.tip();
    frond_rigid_def def = frond_default_rigid_def();
    def.mass = 0;
    def.state.position = {tip.x, tip.y + 0.3, tip.z};
    frond_rigid body = {};
    frond_bond bond = {};
    ASSERT_EQ(frond_rigid_create(accounts.small.world, &def, &body), FROND_OK);
    ASSERT_EQ(frond_bond_create(accounts.small.plant, tip, body, &bond), FROND_OK);
    accounts.slowly([&](double share) {
        def.state.position.x = tip.x + 0.05 * share;
        ASSERT_EQ(frond_rigid_set_state(body, &def.state), FROND_OK);
    });
    expect_given(&Ledger::bonds);
}

TEST_P(LedgerOf, WhatTheWindGivesIsDissipatedInTheEnd) {
    frond_wind_def wind = frond_default_wind_def();
    wind.profile = FROND_WIND_PROFILE_UNIFORM;
    wind.velocity = {4, 0, 0};
    wind.turbulence = 0;
    ASSERT_EQ(frond_world_set_wind(accounts.small.world, &wind), FROND_OK);
    accounts.step(1200);
    const Ledger blown = accounts.now();
    EXPECT_GT(blown.air, 0);
    EXPECT_NEAR(blown.air - blown.dissipated, accounts.gained(), 1e-9);
    EXPECT_GE(blown.dissipated, -blown.error);
    ASSERT_EQ(frond_world_set_wind(accounts.small.world, nullptr), FROND_OK);
    accounts.step(1200);
    EXPECT_NEAR(accounts.gained(), 0, 0.02 * blown.air);
    EXPECT_NEAR(accounts.now().dissipated, blown.air, 0.02 * blown.air);
}

TEST_P(LedgerOf, VelocitiesThatAreSetAreTheCallers) {
    const int count = frond_plant_get_node_count(accounts.small.plant);
    std::vector<frond_vec3> v(size_t(count), frond_vec3{1, 0, 0});
    ASSERT_EQ(frond_plant_set_state(accounts.small.plant, nullptr, &v[0].x, count), FROND_OK);
    const Ledger now = accounts.now();
    EXPECT_GT(now.now.kinetic, 0);
    EXPECT_EQ(now.calls, sum_of(now.now) - sum_of(accounts.begin.now));
    EXPECT_NEAR(now.dissipated, 0, 1e-12);
    accounts.step(600);
    EXPECT_NEAR(accounts.now().dissipated, now.calls, 0.05 * now.calls);
}

// A plant that falls and is reset was lifted by the caller, also where it sleeps from then on.
TEST(Ledger, AResetIsTheCallers) {
    for (const int asleep : {0, 1}) {
        frond_plant_def def = def_with(FROND_MECHANICS_TET_COROTATIONAL);
        def.root_height = -1;
        def.starts_asleep = asleep;
        Accounts accounts(def);
        ASSERT_EQ(frond_plant_wake(accounts.small.plant), FROND_OK);
        accounts.step(30);
        const Ledger fallen = accounts.now();
        ASSERT_LT(fallen.now.gravity, -1) << asleep;
        frond_wind_def wind = frond_default_wind_def();
        wind.velocity.x = 5;  // wakes it in the step
        ASSERT_EQ(frond_world_set_wind(accounts.small.world, &wind), FROND_OK);
        ASSERT_EQ(frond_plant_reset(accounts.small.plant), FROND_OK);
        accounts.step(1);
        const Ledger now = accounts.now();
        EXPECT_NEAR(now.calls - fallen.calls, -sum_of(fallen.now), 1e-3 * -fallen.now.gravity) << asleep;
        EXPECT_NEAR(now.dissipated, fallen.dissipated, 0.02 * -fallen.now.gravity) << asleep;
    }
}

// Restored into its sleep, a plant that had fallen is higher again: no step gave it that, nor took it when it wakes.
TEST(Ledger, WhatIsRestoredIntoSleepIsTheCallers) {
    frond_plant_def def = def_with(FROND_MECHANICS_ROD);
    def.root_height = -1;
    def.starts_asleep = true;
    SmallWorld small(def, 1e7);
    frond_wind_def wind = frond_default_wind_def();  // wakes it within a step
    wind.velocity = {5, 0, 0};
    ASSERT_EQ(frond_world_set_wind(small.world, &wind), FROND_OK);
    std::vector<uint8_t> snapshot(frond_world_get_snapshot_size(small.world));
    ASSERT_EQ(frond_world_save(small.world, snapshot.data(), snapshot.size()), FROND_OK) << frond_last_error();
    const auto now = [&] {
        Ledger ledger = {};
        EXPECT_EQ(frond_world_get_energy_ledger(small.world, &ledger), FROND_OK) << frond_last_error();
        return ledger;
    };
    const auto fall = [&] {
        for (int i = 0; i < 20; i++) EXPECT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
    };
    const Ledger begin = now();
    fall();
    const Ledger fallen = now();
    ASSERT_EQ(frond_world_restore(small.world, snapshot.data(), snapshot.size()), FROND_OK) << frond_last_error();
    fall();
    const Ledger again = now();
    EXPECT_NEAR(again.dissipated - fallen.dissipated, fallen.dissipated - begin.dissipated, 1e-6);
    EXPECT_NEAR(again.calls, sum_of(begin.now) - sum_of(fallen.now), 1e-6);
}

// Plants that go alike are stepped together, but not under a ledger.
TEST(Ledger, ChangesNoBits) {
    uint64_t hashes[2] = {};
    for (const bool has_ledger : {false, true}) {
        SmallWorld small(def_with(FROND_MECHANICS_ROD));
        frond_plant_def def = def_with(FROND_MECHANICS_ROD);
        for (int i = 1; i < 5; i++) {
            def.position.x = i;
            frond_plant plant = {};
            ASSERT_EQ(frond_plant_create(small.world, small.model, &def, &plant), FROND_OK);
        }
        frond_energy_ledger ledger;
        if (has_ledger) {
            ASSERT_EQ(frond_world_get_energy_ledger(small.world, &ledger), FROND_OK);
        }
        for (int i = 0; i < 100; i++) ASSERT_EQ(frond_world_step(small.world, 1.0 / 60), FROND_OK);
        ASSERT_EQ(frond_world_get_state_hash(small.world, &hashes[size_t(has_ledger)]), FROND_OK);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Ledger, APlantThatIsDestroyedTakesItsEnergyAlong) {
    SmallWorld small(def_with(FROND_MECHANICS_ROD));
    frond_energy_ledger ledger = {};
    ASSERT_EQ(frond_world_get_energy_ledger(small.world, &ledger), FROND_OK);
    const double had = sum_of(ledger.now);
    EXPECT_EQ(ledger.begin, had);
    frond_plant_destroy(small.plant);
    ASSERT_EQ(frond_world_get_energy_ledger(small.world, &ledger), FROND_OK);
    EXPECT_EQ(sum_of(ledger.now), 0);
    EXPECT_EQ(ledger.calls, -had);
    EXPECT_EQ(ledger.dissipated, 0);
}

}  // namespace
