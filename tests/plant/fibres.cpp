// Fibres: a blade in a cage is not stretched, neither by a hand nor by a hanging weight; soft materials stretch as they
// should; cages that need no fibres have none; slack fibres change no bit.
#include <gtest/gtest.h>

#include <cmath>

#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"
#include "support/soups.hpp"

namespace frond::test {
namespace fibres_tests {

constexpr double LENGTH = 0.5, WIDTH = 0.05, H = 1.0 / 60;

// Returns an upright blade with its normal along x, and the midrib that presets have.
std::shared_ptr<const Model> blade(double young, double thickness) {
    Surface surface;
    add_sheet(surface, 2, 30, [](double s, double t) { return Vec3(0, t * LENGTH, (s - 0.5) * WIDTH); });
    surface.parts[0].name = "blade";
    frond_organ_material organ = {"blade", plain_material(900, young, 0.3, thickness)};
    organ.material.midrib = 0.05;
    frond_model_def def = model_def();
    def.cage_size = WIDTH / 2;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    return build_from_surface(std::move(surface), def);
}

std::unique_ptr<Plant> plant_of(const std::shared_ptr<const Model>& model, frond_mechanics which,
                                frond_effects effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_PLASTICITY)) {
    frond_plant_def def = plant_def(which);
    def.mass_damping = 2;
    def.stiffness_damping = 0.002;
    def.effects = effects;
    return create_plant(model, def);
}

double chain_length(const Plant& plant) {
    double sum = 0;
    for (size_t i = 0; i < plant.view.chain_positions.size(); i++) {
        const int parent = plant.model->chain.nodes[i].parent;
        if (parent >= 0) sum += (plant.view.chain_positions[i] - plant.view.chain_positions[size_t(parent)]).norm();
    }
    return sum;
}

// Pulls the end of the blade's rim by a hand whose target is `way` beyond, with a spring soft enough for the requested
// force. Returns the chain's length afterwards over that before [-].
double drawn(Plant& plant, const Vec3& way, double force, double& held) {
    const double before = chain_length(plant);
    const int vertex = nearest_vertex(plant, plant.position + Vec3(0, LENGTH, WIDTH / 2));
    const Vec3 start = vertex_position(plant, vertex);
    Surroundings surroundings;
    plant.input.grabs.push_back({vertex, start, force / way.norm(), 1});
    for (int i = 1; i <= 180; i++) {
        plant.input.grabs.back().target = start + std::min(1.0, i / 60.0) * way;
        step_plant(plant, surroundings, H);
        EXPECT_EQ(plant.trouble & FROND_TROUBLE_REWOUND, 0u) << i;
    }
    held = grab_force(plant, plant.input.grabs.back()).norm();
    return chain_length(plant) / before;
}

Fibres fibres_of(const Model& model) {
    const TetNodes nodes = make_tet_nodes(int(model.cage.nodes.size()), model.cage.tets, 1);
    return make_fibres(model, nodes, node_places(nodes, [&](int i) { return model.cage.nodes[size_t(i)]; }));
}

class Pulled : public testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Tets, Pulled,
                         testing::Values(FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN));

TEST_P(Pulled, BladeIsNotDrawnOut) {
    const auto model = blade(5e8, 3e-4);
    double force;
    const auto plant = plant_of(model, GetParam());
    EXPECT_LT(drawn(*plant, {0, 0.2, 0}, 5, force), 1.04);
    EXPECT_GT(force, 4);
    // The rim that the hand holds stays with the blade.
    const Vec3 tip = plant->to_world(plant->view.chain_positions.back());
    EXPECT_LT((vertex_position(*plant, plant->input.grabs.back().vertex) - tip).norm(), 1.3 * WIDTH);

    const auto rubber =
        plant_of(model, GetParam(), FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_FIBRES | FROND_EFFECT_PLASTICITY));
    EXPECT_GT(drawn(*rubber, {0, 0.2, 0}, 5, force), 1.12);
}

TEST_P(Pulled, BladeComesBackAndStandsStill) {
    const auto plant = plant_of(blade(5e8, 3e-4), GetParam());
    double force;
    drawn(*plant, {0.3, 0.1, 0.1}, 3, force);
    plant->input.grabs.clear();
    Surroundings surroundings;
    for (int i = 0; i < 600; i++) step_plant(*plant, surroundings, H);
    EXPECT_EQ(plant->trouble, 0u);
    for (int i = 0; i < node_count_of(*plant); i++)
        EXPECT_LT((point(plant->state.motion.x, i) - point(plant->nodes->modelled, i)).norm(), 0.01 * LENGTH) << i;
}

// By Hooke's law except for the slack: the cage carries a share of the pull from the start, the fibres theirs beyond
// the slack.
TEST_P(Pulled, SoftTissueGivesAsItShould) {
    constexpr double YOUNG = 2e5, RADIUS = 0.006;
    const frond_stem stem = {-1, {0, 0, 0}, {0, LENGTH, 0}, RADIUS, RADIUS};
    const frond_organ_material organ = {"stem", plain_material(900, YOUNG, 0.3, 1e-3)};
    frond_model_def def = model_def();
    def.cage_size = 4 * RADIUS;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    const auto model = build_from_stems(&stem, 1, def);
    ASSERT_FALSE(fibres_of(*model).list.empty());
    double force;
    const double stretched = drawn(*plant_of(model, GetParam()), {0, 0.3, 0}, 4, force) - 1;
    const double expected = force / (YOUNG * M_PI * RADIUS * RADIUS);
    EXPECT_GT(expected, 0.08);
    EXPECT_GT(stretched, 0.95 * expected);
    EXPECT_LT(stretched, 1.15 * expected + 0.03);
}

TEST_P(Pulled, SlackFibresChangeNoBit) {
    const auto model = blade(5e8, 3e-4);
    const auto with = plant_of(model, GetParam());
    const auto without =
        plant_of(model, GetParam(), FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_FIBRES | FROND_EFFECT_PLASTICITY));
    Surroundings surroundings;
    surroundings.gravity = {0.2, 0, 0};
    for (int i = 0; i < 60; i++) {
        step_plant(*with, surroundings, H);
        step_plant(*without, surroundings, H);
    }
    EXPECT_EQ(with->state.motion.x, without->state.motion.x);
    EXPECT_GT((with->state.motion.x - with->nodes->modelled).norm(), 0.001);
}

// Fibre forces are internal: fibres that stay taut, as under a hanging weight, do not restart the integrator in each
// step.
TEST_P(Pulled, IntegratorsLookBackBeyondTautFibres) {
    constexpr int STEPS = 60;
    for (const frond_integrator integrator :
         {FROND_INTEGRATOR_BDF2, FROND_INTEGRATOR_SDIRK2, FROND_INTEGRATOR_GENERALIZED_ALPHA}) {
        const auto plant = plant_of(blade(3e7, 3e-4), GetParam());
        plant->input.settings.integrator = integrator;
        const double before = chain_length(*plant);
        Surroundings surroundings;
        surroundings.gravity = Vec3(0, 10 * GRAVITY, 0);
        int begun_anew = 0, taut = 0;
        for (int i = 0; i < STEPS; i++) {
            step_plant(*plant, surroundings, H);
            taut += chain_length(*plant) > 1.03 * before;
            begun_anew += integrator == FROND_INTEGRATOR_BDF2 ? !history_holds(plant->state.motion, integrator, H)
                                                              : plant->state.motion.history.shaken;
        }
        EXPECT_GT(taut, STEPS / 2) << integrator;
        EXPECT_LT(begun_anew, STEPS / 4) << integrator;
    }
}

TEST(Fibres, AreForCagesThatLackThem) {
    EXPECT_GT(fibres_of(*blade(5e8, 3e-4)).list.size(), 4u);
    EXPECT_TRUE(plant_of(blade(5e8, 3e-4), FROND_MECHANICS_TET_COROTATIONAL)->fibres);
    EXPECT_FALSE(plant_of(blade(5e8, 3e-4), FROND_MECHANICS_TET_LINEAR)->fibres);  // linear tets grow when they rotate
    EXPECT_FALSE(plant_of(blade(5e8, 3e-4), FROND_MECHANICS_ROD)->fibres);
    Model tet;
    tet.calibrated = false;
    EXPECT_TRUE(fibres_of(tet).list.empty());
}

// A handover relaxes by fibres too, and no step of the host led there.
TEST(Fibres, PullBackWhatOtherMechanicsStretched) {
    const auto plant = plant_of(blade(5e8, 3e-4), FROND_MECHANICS_TET_LINEAR);
    const double before = chain_length(*plant);
    // A small rotation taken far is free for linear tets, and stretches.
    constexpr double TURN = 0.7;
    for (int i = 0; i < node_count_of(*plant); i++) {
        const Vec3 place = point(plant->state.motion.x, i);
        point(plant->state.motion.x, i) += TURN * Vec3::UnitZ().cross(place);
    }
    moved(*plant);
    update_chain(*plant);
    EXPECT_GT(chain_length(*plant), 1.15 * before);
    plant->step.x_good.resize(0);
    set_mechanics(*plant, FROND_MECHANICS_TET_COROTATIONAL);
    update_chain(*plant);
    EXPECT_LT(chain_length(*plant), 1.05 * before);
}

// What holds one end of a falling blade stops the rest through its fibres: the plant's momentum is what weight and hand
// gave it, also where a step is divided.
TEST(Fibres, CarryWhatHangsOnThem) {
    for (const int substeps : {1, 4}) {
        frond_plant_def def = plant_def(FROND_MECHANICS_TET_COROTATIONAL);
        def.root_height = -1;
        def.tuning.max_substeps = substeps;
        const std::unique_ptr<Plant> plant = create_plant(blade(1e8, 0.3e-3), def);
        const int vertex = nearest_vertex(*plant, plant->position + Vec3(0, LENGTH, WIDTH / 2));
        plant->input.grabs.push_back({vertex, vertex_position(*plant, vertex), 300, 1});
        Surroundings surroundings;
        surroundings.gravity = {0, -9.81, 0};
        const VecX& mass = node_mass_of(*plant->system);
        double given = 0, momentum = 0;
        bool is_taut = false;
        for (int i = 0; i < 20; i++) {
            step_plant(*plant, surroundings, H);
            given += H * (grab_force(*plant, plant->input.grabs.back()).y() - 9.81 * mass.sum());
            is_taut |= plant->state.stretched > 0;
        }
        for (int i = 0; i < mass.size(); i++) momentum += mass[i] * point(plant->state.motion.v, i).y();
        EXPECT_TRUE(is_taut);
        EXPECT_NEAR(momentum, given, 0.05 * 9.81 * mass.sum() * 20 * H) << substeps << " substeps";
    }
}

}  // namespace fibres_tests

}  // namespace frond::test
