// If the chain moves, the cage follows: exactly at rest, reversibly from any shape that the chain can take, and across
// a change of mechanics.
#include <gtest/gtest.h>

#include <random>

#include "modelling/build.hpp"
#include "plant/pins.hpp"
#include "plant/plant_step.hpp"
#include "support/model_def.hpp"

using namespace frond;

static std::shared_ptr<const Model> forked_model() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.4, 0}, 0.015, 0.012},
                                {0, {0, 0.4, 0}, {0.05, 0.9, 0}, 0.012, 0.006},
                                {0, {0, 0.4, 0}, {-0.3, 0.6, 0.1}, 0.008, 0.004}};
    return build_from_stems(stems, 3, frond::test::model_def());
}

static std::unique_ptr<Plant> make_plant(frond_mechanics which) {
    return create_plant(forked_model(), test::plant_def(which));
}

static void swing(Plant& plant, int steps) {
    Surroundings surroundings;
    surroundings.gravity = Vec3(3, -9.81, 1);
    for (int i = 0; i < steps; i++) {
        step_plant(plant, surroundings, 1.0 / 60);
        ASSERT_EQ(plant.trouble, 0u);
    }
}

TEST(Follow, CageIsWhereItWasModelledAtRest) {
    const auto plant = make_plant(FROND_MECHANICS_ROD);
    const VecX& x = cage_places(*plant);
    for (size_t n = 0; n < plant->model->cage.nodes.size(); n++)
        EXPECT_LT((point(x, int(n)) - plant->model->cage.nodes[n]).norm(), 1e-12);
}

TEST(Follow, AStateThatWasReadIsSetAgain) {
    const auto plant = make_plant(FROND_MECHANICS_ROD);
    swing(*plant, 20);
    const VecX x = cage_places(*plant), v = cage_velocities(*plant);
    swing(*plant, 30);
    EXPECT_GT((cage_places(*plant) - x).lpNorm<Eigen::Infinity>(), 1e-3);
    set_state(*plant, x.data(), v.data());
    EXPECT_LT((cage_places(*plant) - x).lpNorm<Eigen::Infinity>(), 1e-6);
    EXPECT_LT((cage_velocities(*plant) - v).lpNorm<Eigen::Infinity>(), 1e-4 * v.lpNorm<Eigen::Infinity>());
}

TEST(Follow, ChangingMechanicsDoesNotMakeThePlantJump) {
    const auto plant = make_plant(FROND_MECHANICS_ROD);
    swing(*plant, 20);
    const VecX x = cage_places(*plant), v = cage_velocities(*plant);
    set_mechanics(*plant, FROND_MECHANICS_TET_COROTATIONAL);
    EXPECT_EQ((cage_places(*plant) - x).norm(), 0);
    EXPECT_EQ((cage_velocities(*plant) - v).norm(), 0);
    swing(*plant, 20);
    const VecX cage = cage_places(*plant);
    set_mechanics(*plant, FROND_MECHANICS_ROD);
    // The chain cannot take every shape of the cage; it comes within a hundredth of the plant's height.
    EXPECT_LT((cage_places(*plant) - cage).lpNorm<Eigen::Infinity>(), 0.01);
    swing(*plant, 20);
}

// A plant that swings under a pull to and fro is handed on every few steps, to mechanics in any order.
TEST(Follow, ChangesOfMechanicsAddNoEnergy) {
    const frond_mechanics all[] = {FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                   FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD, FROND_MECHANICS_SPRING_CHAIN};
    std::mt19937 random(7);
    for (const int every : {1, 3, 12}) {
        const auto plant = make_plant(FROND_MECHANICS_TET_COROTATIONAL);
        const double weight = node_mass_of(*plant->system).sum() * 9.81, none = 0.002 * weight * double(plant->size);
        Surroundings surroundings;
        for (int change = 0; change < 240 / every + 20; change++) {
            surroundings.gravity = Vec3(change / 10 % 2 ? 6 : -6, -9.81, 2);
            for (int i = 0; i < every; i++) step_plant(*plant, surroundings, 1.0 / 60);
            const StoredEnergy before = stored_energy(*plant);
            const frond_mechanics from = plant->which, to = all[random() % 5];
            set_mechanics(*plant, to);
            const StoredEnergy after = stored_energy(*plant);
            EXPECT_LE(after.potential, before.potential + none) << from << " to " << to << ", change " << change;
            EXPECT_LE(after.kinetic, before.kinetic + none) << from << " to " << to << ", change " << change;
        }
        surroundings.gravity = Vec3(0, -9.81, 0);
        for (int i = 0; i < 600; i++) step_plant(*plant, surroundings, 1.0 / 60);
        const VecX now = cage_places(*plant);
        for (size_t n = 0; n < plant->model->cage.nodes.size(); n++)
            EXPECT_LT((point(now, int(n)) - plant->model->cage.nodes[n]).norm(), 0.02);
    }
}

// A chain holds a pinned node by a spring; a cage holds the node itself.
TEST(Follow, APinIsHeldAfterAChangeOfMechanicsToo) {
    for (const frond_mechanics first : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL}) {
        const bool is_rod = first == FROND_MECHANICS_ROD;
        const auto plant = make_plant(first);
        const std::vector<Vec3>& nodes = plant->model->cage.nodes;
        size_t top = 0;
        for (size_t n = 0; n < nodes.size(); n++)
            if (nodes[n].y() > nodes[top].y()) top = n;
        pin_node(*plant, int(top));
        swing(*plant, 10);
        EXPECT_EQ(plant->input.pin_springs.size(), is_rod ? 1u : 0u);
        set_mechanics(*plant, is_rod ? FROND_MECHANICS_TET_COROTATIONAL : FROND_MECHANICS_ROD);
        swing(*plant, 10);
        EXPECT_EQ(plant->input.pin_springs.size(), is_rod ? 0u : 1u);
        EXPECT_LT((point(cage_places(*plant), int(top)) - nodes[top]).norm(), 1e-4);
    }
}

TEST(Follow, PinsHoldCageNodesAndTheRootStaysWhereItIs) {
    const auto plant = make_plant(FROND_MECHANICS_ROD);
    const std::vector<Vec3>& nodes = plant->model->cage.nodes;
    size_t top = 0;
    for (size_t n = 0; n < nodes.size(); n++)
        if (nodes[n].y() > nodes[top].y()) top = n;
    pin_node(*plant, int(top));
    const Vec3 target = nodes[top] + Vec3(0.05, -0.01, 0.02);
    move_pin(*plant, int(top), target);
    Surroundings surroundings;
    surroundings.gravity = Vec3(0, -9.81, 0);
    for (int i = 0; i < 200; i++) step_plant(*plant, surroundings, 1.0 / 60);
    EXPECT_LT((point(cage_places(*plant), int(top)) - target).norm(), 1e-5);
    for (size_t n = 0; n < nodes.size(); n++)
        if (plant->model->root[n]) {
            EXPECT_LT((point(cage_places(*plant), int(n)) - nodes[n]).norm(), 1e-3);
        }
    unpin_node(*plant, int(top));
    for (int i = 0; i < 60; i++) step_plant(*plant, surroundings, 1.0 / 60);
    EXPECT_GT((point(cage_places(*plant), int(top)) - target).norm(), 1e-3);
}
