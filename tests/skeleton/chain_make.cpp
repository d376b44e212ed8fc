// Chains of shapes with known skeletons, of triangle soups and of hostile input.
#include <gtest/gtest.h>

#include "chain_shapes.hpp"
#include "core/error.hpp"
#include "core/timer.hpp"

namespace frond {
namespace chain_make_tests {

using namespace test;

// Checks what holds for every chain.
void expect_forest(const Grown& grown) {
    const Chain& chain = grown.chain;
    ASSERT_FALSE(chain.nodes.empty());
    int capsules = 0;
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        ASSERT_GE(node.parent, -1);
        ASSERT_LT(node.parent, int(i));
        capsules += node.parent >= 0;
        EXPECT_TRUE(node.position.allFinite());
        EXPECT_TRUE(std::isfinite(node.radius) && node.radius > 0) << i << " " << node.radius;
        EXPECT_LE(node.radius, grown.surface.size());
        EXPECT_GE(node.organ, 0);
        EXPECT_LT(node.organ, int(grown.organs.size()));
        if (node.parent < 0) {
            EXPECT_EQ(node.distance, 0);
        } else {
            const ChainNode& parent = chain.nodes[size_t(node.parent)];
            const double step = (node.position - parent.position).norm();
            EXPECT_GT(step, 0) << i;
            EXPECT_NEAR(node.distance, parent.distance + step, 1e-9 * grown.surface.size());
        }
    }
    EXPECT_GE(capsules, 1);
    EXPECT_EQ(capsules + chain.root_count(), int(chain.nodes.size()));
    ASSERT_EQ(chain.vertex_node.size(), grown.surface.positions.size());
    for (int node : chain.vertex_node) {
        ASSERT_GE(node, 0);
        ASSERT_LT(node, int(chain.nodes.size()));
    }
}

TEST(Chain, OfAStraightTubeIsALineOfItsLengthAndRadius) {
    for (const double height : {0.1, 0.3, 0.07})
        for (const int cells : {1, 7, 50}) {
            Sketch sketch;
            sketch.tube(line({0.3, 0, 0}, {0.3, 1, 0}, cells), 0.02, 12);
            const Grown grown = grow(sketch, {height, 0});
            expect_forest(grown);
            EXPECT_EQ(grown.chain.nodes.size(), size_t(std::ceil(1 / height - 1e-9)) + 1) << height << " " << cells;
            EXPECT_EQ(grown.chain.root_count(), 1);
            EXPECT_EQ(grown.chain.fork_count(), 0);
            EXPECT_NEAR(grown.chain.length(), 1, 0.03);
            for (const ChainNode& node : grown.chain.nodes) {
                EXPECT_NEAR(node.radius, 0.02, 0.002);
                EXPECT_NEAR(node.position.x(), 0.3, 1e-3);
                EXPECT_NEAR(node.position.z(), 0, 1e-3);
            }
        }
}

TEST(Chain, OfABentTubeFollowsItsAxis) {
    std::vector<Vec3> arc;
    for (int i = 0; i <= 60; i++) arc.push_back({1 - std::cos(i * M_PI / 60), std::sin(i * M_PI / 60), 0});
    Sketch sketch;
    sketch.begin_part("stem");
    sketch.tube(arc, 0.03, 10);
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_EQ(grown.chain.root_count(), 2);  // both ends are near the ground
    for (const ChainNode& node : grown.chain.nodes) EXPECT_NEAR((node.position - Vec3(1, 0.01, 0)).norm(), 1, 0.04);
}

TEST(Chain, HasTheMidlineOfABladeAndItsSpreadAsRadius) {
    Sketch sketch;
    sketch.begin_part("leaf");
    sketch.strip(line({0, 0, 0}, {0.2, 1, 0}, 12), 0.08, Vec3::UnitZ(), 4);
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_NEAR(grown.chain.length(), std::sqrt(1.04), 0.05);
    for (const ChainNode& node : grown.chain.nodes) {
        EXPECT_NEAR(node.position.z(), 0, 0.004);
        EXPECT_NEAR(node.radius, 0.08 / std::sqrt(12.0), 0.004);
    }
}

// A plant that lies level begins at the end that is nearer to the origin.
TEST(Chain, OfWhatLiesLevelRunsAlongIt) {
    for (const double rise : {0.0, 1e-4, 0.02})
        for (const bool tube : {false, true})
            for (const double from : {0.0, 0.5}) {
                SCOPED_TRACE(testing::Message() << "rise " << rise << ", tube " << tube << ", from " << from);
                Sketch sketch;
                const Vec3 begin(from, 0.03, 0), end(from + 0.4, 0.03 + rise, 0.3);
                if (tube)
                    sketch.tube(line(begin, end, 20), 0.01, 8);
                else
                    sketch.strip(line(begin, end, 20), 0.08, Vec3(-0.6, 0, 0.8));
                const Grown grown = grow(sketch, {0.05, 0});
                expect_forest(grown);
                EXPECT_EQ(grown.chain.root_count(), 1);
                EXPECT_NEAR(grown.chain.length(), 0.5, 0.03);
                EXPECT_LT((grown.chain.nodes.front().position - begin).norm(), 0.02);
            }
}

TEST(Chain, OfAYHasOneForkOnItsMiddle) {
    Sketch sketch;
    sketch.begin_part("stem");
    // Two arms that share the ring in which the trunk ends.
    const int trunk = sketch.tube(line({0, 0, 0}, {0, 0.5, 0}, 10), 0.02, 12);
    const int ring = trunk + 10 * 12;
    for (const double side : {-1.0, 1.0}) {
        const int arm = sketch.tube(line({side * 0.02, 0.52, 0}, {side * 0.35, 0.85, 0}, 9), 0.02, 12);
        for (int k = 0; k < 12; k++) {
            sketch.triangle(ring + k, ring + (k + 1) % 12, arm + (k + 1) % 12);
            sketch.triangle(ring + k, arm + (k + 1) % 12, arm + k);
        }
    }
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_EQ(grown.chain.root_count(), 1);
    EXPECT_EQ(grown.chain.fork_count(), 1);
    EXPECT_NEAR(grown.chain.length(), 0.5 + 2 * 0.48, 0.1);
    for (const ChainNode& node : grown.chain.nodes) EXPECT_NEAR(node.position.z(), 0, 0.01);
}

TEST(Chain, GivesEachOfFiveLeavesABranch) {
    for (const bool names : {true, false}) {
        const Grown grown = grow(leafy_plant(5, names), {0.1, 0});
        expect_forest(grown);
        EXPECT_EQ(grown.chain.root_count(), 1);
        const std::vector<ChainNode>& nodes = grown.chain.nodes;
        std::vector<int> children(nodes.size(), 0);
        for (const ChainNode& node : nodes)
            if (node.parent >= 0) children[size_t(node.parent)]++;
        int leaf_tips = 0, stem_tips = 0;
        for (size_t i = 0; i < nodes.size(); i++) {
            if (children[i] > 0) continue;
            const bool blade = grown.organs[size_t(nodes[i].organ)].kind == "blade";
            (blade ? leaf_tips : stem_tips)++;
            // Leaves end 0.3 m out; they do not shift the stem's axis.
            EXPECT_NEAR(std::hypot(nodes[i].position.x(), nodes[i].position.z()), blade ? 0.3 : 0.0, 0.02);
        }
        EXPECT_EQ(leaf_tips, 5);
        EXPECT_EQ(stem_tips, 1);
        for (const ChainNode& node : nodes)
            if (grown.organs[size_t(node.organ)].kind == "stem") {
                EXPECT_LT(std::hypot(node.position.x(), node.position.z()), 0.002);
            }
    }
}

TEST(Chain, OfARingIsATreeWithoutCycle) {
    std::vector<Vec3> round;
    for (int i = 0; i <= 40; i++)
        round.push_back({0.5 * std::sin(i * M_PI / 20), 0.5 - 0.5 * std::cos(i * M_PI / 20), 0});
    Sketch sketch;
    sketch.begin_part("stem");
    sketch.tube(round, 0.02, 8);
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_EQ(grown.chain.root_count(), 1);
    EXPECT_NEAR(grown.chain.length(), M_PI, 0.25);
}

TEST(Chain, RootsEveryStemThatStandsOnTheGround) {
    Sketch sketch;
    for (int i = 0; i < 3; i++) {
        sketch.begin_part("stem" + std::to_string(i));
        sketch.tube(line({0.3 * i, 0.004 * i, 0}, {0.3 * i, 1, 0.1}, 10), 0.01, 6);
    }
    EXPECT_EQ(grow(sketch).chain.root_count(), 3);
}

TEST(Chain, IsNotRootedInADroopingLeaf) {
    Sketch sketch;
    sketch.begin_part("stem");
    sketch.tube(line({0, 0, 0}, {0, 1, 0}, 10), 0.01, 8);
    sketch.begin_part("leaf");
    sketch.strip({{0, 0.3, 0}, {0.1, 0.35, 0}, {0.2, 0.3, 0}, {0.25, 0.1, 0}, {0.26, -0.2, 0}}, 0.04, Vec3::UnitZ());
    const Grown grown = grow(sketch);
    expect_forest(grown);
    ASSERT_EQ(grown.chain.root_count(), 1);
    EXPECT_LT(grown.chain.nodes[0].position.norm(), 0.02);
}

TEST(Chain, StandsOnItsPot) {
    Sketch sketch;
    sketch.begin_part("pot");
    sketch.tube(line({0, -0.2, 0}, {0, 0, 0}, 4), 0.1, 16);
    sketch.begin_part("soil");
    const int middle = sketch.add({0, -0.02, 0});
    for (int k = 0; k < 16; k++) sketch.add({0.1 * std::cos(k * M_PI / 8), -0.02, 0.1 * std::sin(k * M_PI / 8)});
    for (int k = 0; k < 16; k++) sketch.triangle(middle, middle + 1 + k, middle + 1 + (k + 1) % 16);
    sketch.begin_part("stem");
    sketch.tube(line({0, -0.03, 0}, {0, 0.6, 0}, 10), 0.01, 8);
    const Grown grown = grow(sketch);
    expect_forest(grown);
    EXPECT_EQ(grown.chain.root_count(), 1);
    EXPECT_NEAR(grown.chain.nodes[0].position.y(), -0.2, 0.01);
}

// Ties share corners with stem and stake, or have meshes of their own beside them.
class TiedChain : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Ties, TiedChain, testing::Bool());

TEST_P(TiedChain, GrowsOutOfTheStakeWhereTheStemIsTied) {
    const bool is_loose = GetParam();
    Sketch sketch;
    sketch.begin_part("stake");
    const int stake = sketch.tube(line({0, 0, 0}, {0, 1, 0}, 20), 0.01, 6);
    sketch.begin_part("stem");
    const int stem = sketch.tube(line({0.03, 0, 0}, {0.03, 0.95, 0}, 19), 0.008, 6);
    const std::vector<double> heights = {0.35, 0.7};
    for (const double height : heights) {
        const int corner = 6 * int(std::lround(height / 0.05));
        sketch.begin_part("tie");
        int ends[] = {stake + corner, stem + corner};
        if (is_loose)
            for (int& end : ends) end = sketch.add(sketch.surface.positions[size_t(end)] + Vec3(0, 5e-4, 0));
        sketch.triangle(ends[0], ends[1], sketch.add({0.015, height, 0.02}));
    }
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_EQ(grown.chain.root_count(), 2);
    std::vector<double> carried;
    for (const ChainNode& node : grown.chain.nodes) {
        if (node.parent < 0 || grown.organs[size_t(node.organ)].kind != "stem") continue;
        const ChainNode& below = grown.chain.nodes[size_t(node.parent)];
        if (grown.organs[size_t(below.organ)].kind == "support") carried.push_back(below.position.y());
    }
    ASSERT_EQ(carried.size(), heights.size());
    for (size_t i = 0; i < heights.size(); i++) EXPECT_NEAR(carried[i], heights[i], 0.1);
    // The stem goes on across each tie.
    ASSERT_EQ(grown.chain.loops.size(), heights.size());
    for (const auto& [below, above] : grown.chain.loops) {
        const Vec3 &from = grown.chain.nodes[size_t(below)].position, &to = grown.chain.nodes[size_t(above)].position;
        for (const Vec3& place : {from, to}) EXPECT_NEAR(place.x(), 0.03, 1e-3);
        EXPECT_NEAR(to.y() - from.y(), 0.1, 0.02);
    }
}

TEST(Chain, KeepsTheRadiusThatIsGiven) {
    for (const ChainNode& node : grow(leafy_plant(3, true), {0.2, 0.025}).chain.nodes) EXPECT_EQ(node.radius, 0.025);
}

TEST(Chain, ChoosesAReasonableCountOfCapsules) {
    for (const int leaves : {0, 1, 10, 60, 400}) {
        const Grown grown = grow(leafy_plant(leaves, false));
        expect_forest(grown);
        EXPECT_GE(grown.chain.nodes.size(), 20u) << leaves;
        EXPECT_LE(grown.chain.nodes.size(), 450u) << leaves;
    }
}

TEST(Chain, MergesLobesAndTinyPartsButKeepsTwigs) {
    Sketch sketch;
    sketch.begin_part("stem");
    sketch.tube(line({0, 0, 0}, {0, 1, 0}, 20), 0.01, 8);
    // Buds of 1 cm, and one real twig.
    for (int i = 0; i < 40; i++) {
        sketch.begin_part("bud" + std::to_string(i));
        const double y = 0.1 + 0.02 * i;
        sketch.strip(line({0.009, y, 0}, {0.02, y, 0}, 2), 0.005, Vec3::UnitY());
    }
    sketch.begin_part("twig");
    sketch.tube(line({0.005, 0.5, 0}, {0.25, 0.6, 0}, 6), 0.004, 6);
    const Grown grown = grow(sketch, {0.1, 0});
    expect_forest(grown);
    EXPECT_EQ(grown.chain.fork_count(), 1);
    EXPECT_NEAR(grown.chain.length(), 1.26, 0.08);
}

TEST(Chain, BindsVerticesToTheNearestNodeAlongTheSurface) {
    Sketch sketch;
    sketch.tube(line({0, 0, 0}, {0, 1, 0}, 40), 0.01, 8);
    const Grown grown = grow(sketch, {0.1, 0});
    for (size_t v = 0; v < grown.surface.positions.size(); v++) {
        const double y = grown.surface.positions[v].y();
        EXPECT_NEAR(grown.chain.nodes[size_t(grown.chain.vertex_node[v])].position.y(), y, 0.0501);
    }
    // Two tubes side by side: no vertex is assigned to the other tube's nodes, however near.
    Sketch pair;
    pair.begin_part("stem_a");
    pair.tube(line({0, 0, 0}, {0, 1, 0}, 20), 0.01, 8);
    pair.begin_part("stem_b");
    pair.tube(line({0.025, 0, 0}, {0.025, 1, 0}, 20), 0.01, 8);
    const Grown both = grow(pair, {0.1, 0});
    for (size_t v = 0; v < both.surface.positions.size(); v++)
        EXPECT_NEAR(both.chain.nodes[size_t(both.chain.vertex_node[v])].position.x(), v < 168 ? 0 : 0.025, 0.002);
}

TEST(Chain, OfSoupsIsAForestThatCoversAllVertices) {
    for (int seed = 0; seed < 30; seed++) {
        SCOPED_TRACE(seed);
        const Grown grown = grow(soup(seed, 10 + 20 * seed, seed % 3 ? 0.05 : 0.6));
        expect_forest(grown);
        if (HasFatalFailure()) return;
    }
    // Capsule heights that do not suit the shape.
    for (const double height : {0.003, 0.2, 50.0}) expect_forest(grow(soup(7, 200, 0.1), {height, 0}));
}

TEST(Chain, OfOneTriangleHasOneCapsule) {
    Sketch sketch;
    sketch.triangle(sketch.add({0, 0, 0}), sketch.add({1, 0, 0}), sketch.add({0, 0, 1}));
    const Grown grown = grow(sketch);
    expect_forest(grown);
}

TEST(Chain, ManagesHundredsOfLooseParts) {
    Sketch sketch = leafy_plant(5, false);
    std::mt19937_64 engine(3);
    const auto dice = [&] { return double(engine() >> 11) * 0x1p-53; };
    for (int i = 0; i < 800; i++) {
        const Vec3 at(dice() - 0.5, 0.3 + dice(), dice() - 0.5);
        sketch.strip(line(at, at + 0.04 * Vec3(dice() - 0.5, dice() - 0.5, dice() - 0.5).normalized(), 1), 0.03,
                     Vec3::UnitY(), 1);
    }
    const Grown grown = grow(sketch);
    expect_forest(grown);
    EXPECT_LE(grown.chain.nodes.size(), 450u);
}

TEST(Chain, IsTheSameEachTime) {
    const Grown a = grow(soup(5, 300, 0.1)), b = grow(soup(5, 300, 0.1));
    ASSERT_EQ(a.chain.nodes.size(), b.chain.nodes.size());
    for (size_t i = 0; i < a.chain.nodes.size(); i++) {
        EXPECT_EQ(a.chain.nodes[i].position, b.chain.nodes[i].position);
        EXPECT_EQ(a.chain.nodes[i].radius, b.chain.nodes[i].radius);
        EXPECT_EQ(a.chain.nodes[i].parent, b.chain.nodes[i].parent);
    }
    EXPECT_EQ(a.chain.vertex_node, b.chain.vertex_node);
}

TEST(Chain, RefusesHeightsAndRadiiThatMakeNoSense) {
    const Sketch sketch = leafy_plant(2, true);
    for (const ChainOptions& options :
         {ChainOptions{-1, 0}, ChainOptions{NAN, 0}, ChainOptions{INFINITY, 0}, ChainOptions{1e-9, 0},
          ChainOptions{0, -1}, ChainOptions{0, NAN}, ChainOptions{0, INFINITY}})
        EXPECT_THROW(grow(sketch, options), Error) << options.height << " " << options.radius;
}

TEST(Chain, IsQuick) {
    Sketch sketch;
    sketch.begin_part("stem");
    sketch.tube(line({0, 0, 0}, {0, 2, 0}, 400), 0.02, 38);
    const int triangles = int(sketch.surface.triangles.size());
    Surface surface = sketch.surface;
    Topology topology = make_topology(surface);
    const std::vector<Organ> organs = find_organs(surface, topology);
    Timer timer;
    make_chain(surface, topology, organs, {});
    // The goal is 0.1 s for 30,000 triangles; sanitizers and busy machines get more.
    EXPECT_LT(timer.ms(), 3000) << triangles;
    RecordProperty("milliseconds", int(timer.ms()));
}

}  // namespace chain_make_tests

}  // namespace frond
