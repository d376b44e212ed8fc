// Everything that follows the cage: surface, normals and chain of one plant, without a world.
#include "plant/plant_step.hpp"

#include <gtest/gtest.h>

#include <set>

#include "modelling/build.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"

using namespace frond;

static std::shared_ptr<const Model> small_model() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.5, 0}, 0.02, 0.015},
                                {0, {0, 0.5, 0}, {0.2, 0.8, 0}, 0.015, 0.01}};
    return build_from_surface(surface_from_stems(stems, 2), test::model_def());
}

static frond_plant_def plant_def(int order = 1) {
    return test::plant_def(FROND_MECHANICS_TET_COROTATIONAL, order);
}

// Moves all nodes of a plant by x -> A x + b in its own frame.
static void deform(Plant& plant, const Mat3& A, const Vec3& b) {
    for (int i = 0; i < plant.state.motion.x.size() / 3; i++)
        point(plant.state.motion.x, i) = A * point(plant.nodes->modelled, i) + b;
    update_chain(plant);
    update_surface(plant, FROND_EFFECT_ALL);
}

struct EveryOrder : testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Order, EveryOrder, testing::Range(1, HIGHEST_ORDER + 1));

TEST_P(EveryOrder, SurfaceFollowsAnAffineMoveOfTheCageExactly) {
    const auto plant = create_plant(small_model(), plant_def(GetParam()));
    Mat3 A;
    A << 1.2, 0.3, 0, -0.2, 0.9, 0.1, 0.05, 0, 1.1;
    const Vec3 b(0.3, -0.2, 0.7);
    deform(*plant, A, b);
    const Surface& surface = plant->model->surface;
    const Mat3 cofactor = A.determinant() * A.inverse().transpose();
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3 position = A * surface.positions[v] + b;
        const Vec3 normal = (cofactor * surface.normals[v].cast<double>()).normalized();
        for (int axis = 0; axis < 3; axis++) {
            EXPECT_NEAR(plant->view.surface_positions[3 * v + size_t(axis)], position[axis], 2e-6);
            EXPECT_NEAR(plant->view.surface_normals[3 * v + size_t(axis)], normal[axis], 1e-5);
        }
    }
    for (size_t i = 0; i < plant->model->chain.nodes.size(); i++)
        EXPECT_LT((plant->view.chain_positions[i] - (A * plant->model->chain.nodes[i].position + b)).norm(), 1e-9);
}

TEST(Surface, OfQuadraticTetsFollowsACurvedMoveExactly) {
    const auto plant = create_plant(small_model(), plant_def(2));
    const auto bend = [](const Vec3& p) {
        return Vec3(p.x() + 0.4 * p.y() * p.y(), p.y() - 0.2 * p.x() * p.z(), p.z() + 0.3 * p.x() * p.y());
    };
    for (int i = 0; i < node_count_of(*plant); i++)
        point(plant->state.motion.x, i) = bend(point(plant->nodes->modelled, i));
    moved(*plant);
    update_surface(*plant, FROND_EFFECT_ALL);
    const Surface& surface = plant->model->surface;
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3 position = bend(surface.positions[v]), now = vertex_position(*plant, int(v));
        EXPECT_LT((now - position).norm(), 1e-12);
        EXPECT_LT((attachment_place(vertex_attachment(*plant, int(v)), plant->state.motion.x) - position).norm(),
                  1e-12);
        EXPECT_NEAR(plant->view.surface_positions[3 * v], position.x(), 1e-6);
    }
    for (size_t i = 0; i < plant->model->chain.nodes.size(); i++)
        EXPECT_LT((plant->view.chain_positions[i] - bend(plant->model->chain.nodes[i].position)).norm(), 1e-12);

    // A normal is that of the bent surface, within the accuracy of the tets.
    double worst = 1;
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3& p = surface.positions[v];
        Mat3 F;
        F << 1, 0.8 * p.y(), 0, -0.2 * p.z(), 1, -0.2 * p.x(), 0.3 * p.y(), 0.3 * p.x(), 1;
        const Vec3 expected = (F.inverse().transpose() * surface.normals[v].cast<double>()).normalized();
        worst = std::min(worst, expected.dot(Eigen::Map<Vec3f>(&plant->view.surface_normals[3 * v]).cast<double>()));
    }
    EXPECT_GT(worst, std::cos(0.05));
}

TEST(Nodes, OfQuadraticTetsAreTheCagesAndThenTheMiddlesOfItsEdges) {
    const auto model = small_model();
    const auto plant = create_plant(model, plant_def(2));
    const int corners = int(model->cage.nodes.size());
    ASSERT_GT(node_count_of(*plant), corners);
    for (int i = 0; i < corners; i++) EXPECT_EQ(Vec3(point(cage_places(*plant), i)), model->cage.nodes[size_t(i)]);
    std::set<Edge> edges;
    for (const Tet& tet : model->cage.tets)
        for (int a : tet)
            for (int b : tet)
                if (a < b) edges.insert({a, b});
    ASSERT_EQ(node_count_of(*plant), corners + int(edges.size()));
    int i = corners, held = 0;
    for (const auto& [a, b] : edges) {
        const Vec3 middle = 0.5 * (model->cage.nodes[size_t(a)] + model->cage.nodes[size_t(b)]);
        EXPECT_LT((point(cage_places(*plant), i) - middle).norm(), 1e-15);
        EXPECT_EQ(bool(plant->input.pinned[size_t(i)]),
                  plant->input.pinned[size_t(a)] && plant->input.pinned[size_t(b)]);
        held += plant->input.pinned[size_t(i++)];
    }
    EXPECT_GT(held, 4);
}

// From tets to rods and back: the host sees the same nodes throughout, in the same positions.
TEST(Nodes, OfQuadraticTetsStayWhateverMoves) {
    const auto plant = create_plant(small_model(), plant_def(2));
    const VecX start = cage_places(*plant);
    for (int which = FROND_MECHANICS_COUNT - 1; which >= 0; which--) {
        set_mechanics(*plant, frond_mechanics(which));
        ASSERT_EQ(cage_places(*plant).size(), start.size()) << which;
        EXPECT_LT((cage_places(*plant) - start).cwiseAbs().maxCoeff(), 1e-6) << which;
    }
}

TEST(Surface, StandsInTheWorldWhereThePlantIsPlaced) {
    frond_plant_def def = plant_def();
    def.position = {5, 6, 7};
    def.rotation = {0, 0, 2, 2};  // a quarter turn about z, not normalised
    const auto plant = create_plant(small_model(), def);
    update_surface(*plant, FROND_EFFECT_ALL);
    const Surface& surface = plant->model->surface;
    for (size_t v = 0; v < surface.positions.size(); v++) {
        const Vec3& rest = surface.positions[v];
        EXPECT_NEAR(plant->view.surface_positions[3 * v], 5 - rest.y(), 2e-6);
        EXPECT_NEAR(plant->view.surface_positions[3 * v + 1], 6 + rest.x(), 2e-6);
        EXPECT_NEAR(plant->view.surface_positions[3 * v + 2], 7 + rest.z(), 2e-6);
    }
}

TEST(Root, IsHeldAtTheFootAndNowhereElse) {
    const auto plant = create_plant(small_model(), plant_def());
    int pinned = 0;
    for (size_t i = 0; i < plant->state.motion.pinned.size(); i++) {
        if (!plant->state.motion.pinned[i]) continue;
        pinned++;
        EXPECT_LT(plant->model->cage.nodes[i].y(), 0.3);
    }
    EXPECT_GE(pinned, 4);
    frond_plant_def def = plant_def();
    def.root_height = -1;
    const auto loose = create_plant(small_model(), def);
    for (uint8_t p : loose->state.motion.pinned) EXPECT_FALSE(p);
    def.root_height = 0.4;
    const auto half = create_plant(small_model(), def);
    for (size_t i = 0; i < half->state.motion.pinned.size(); i++)
        EXPECT_EQ(bool(half->state.motion.pinned[i]),
                  half->model->cage.nodes[i].y() < half->model->surface.lower().y() + 0.4);
}

// All nodes that the ground holds are nearer to one root than to the other.
TEST(Root, OfEveryChainIsHeldBelowTheRootHeight) {
    frond_organ_material material = {"stem", plain_material(800, 1e9, 0.3, 1e-3)};
    frond_model_def model = test::model_def();
    model.organs = &material;
    model.organ_count = 1;
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.6, 0}, 0.03, 0.03},
                                {-1, {0.035, 0.01, 0}, {0.4, 0.4, 0}, 0.002, 0.002}};
    frond_plant_def def = plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    for (const double root_height : {0.0, 0.01, 0.02, 0.1}) {
        def.root_height = root_height;
        const auto plant = create_plant(build_from_stems(stems, 2, model), def);
        const std::vector<Vec3> before = plant->view.chain_positions;
        Surroundings surroundings;
        surroundings.gravity = {0, -GRAVITY, 0};
        for (int i = 0; i < 120; i++) step_plant(*plant, surroundings, 1.0 / 60);
        for (size_t i = 0; i < before.size(); i++)
            EXPECT_LT((plant->view.chain_positions[i] - before[i]).norm(), 0.01)
                << "root height " << root_height << ", node " << i;
    }
}

TEST(Plants, OfOneModelShareTheirSystem) {
    const auto model = small_model();
    const auto a = create_plant(model, plant_def()), b = create_plant(model, plant_def());
    EXPECT_EQ(a->system.get(), b->system.get());
    frond_plant_def def = plant_def();
    def.tuning.mass = FROND_MASS_CONSISTENT;
    EXPECT_NE(create_plant(model, def)->system.get(), a->system.get());
    EXPECT_NE(create_plant(model, plant_def(2))->system.get(), a->system.get());
}

TEST(Grab, TakesTheNearestVertex) {
    const auto plant = create_plant(small_model(), plant_def());
    const Surface& surface = plant->model->surface;
    for (size_t v = 0; v < surface.positions.size(); v += 7)
        EXPECT_LT((vertex_position(*plant, nearest_vertex(*plant, surface.positions[v])) - surface.positions[v]).norm(),
                  1e-9);
}
