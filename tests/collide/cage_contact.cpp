// Contacts of cages: the same with every layout of the hash, found wherever FCL sees boundaries cross, and with depths
// and normals along which bodies separate in the right direction.
#include "collide/cage_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/timer.hpp"
#include "support/cages.hpp"

namespace frond::test {
namespace cage_contact_tests {

bool same(const ContactSide& a, const ContactSide& b) {
    return a.body == b.body && a.organ == b.organ && a.node_count == b.node_count && a.nodes == b.nodes &&
           a.weights == b.weights;
}
bool same(const CageContact& a, const CageContact& b) {
    return a.kind == b.kind && same(a.a, b.a) && same(a.b, b.b) && a.point == b.point && a.normal == b.normal &&
           a.depth == b.depth;
}

void expect_sound(const std::vector<CollisionBody>& bodies, const std::vector<CageContact>& contacts) {
    for (const CageContact& contact : contacts) {
        ASSERT_TRUE(contact.point.allFinite() && contact.normal.allFinite());
        EXPECT_NEAR(contact.normal.norm(), 1, 1e-12);
        EXPECT_GT(contact.depth, 0);
        // Opposite forces along the normal on both points exert no torque.
        const Vec3 a = place_of(bodies, contact.a), b = place_of(bodies, contact.b);
        EXPECT_LT((contact.point - a).norm(), 1e-12);
        EXPECT_LT((b - a).cross(contact.normal).norm(), 1e-9);
        for (const ContactSide* side : {&contact.a, &contact.b}) {
            double sum = 0;
            for (size_t k = 0; k < 4; ++k) {
                EXPECT_GE(side->weights[k], -1e-9);
                EXPECT_TRUE(int(k) < side->node_count || side->weights[k] == 0);
                sum += side->weights[k];
            }
            EXPECT_NEAR(sum, 1, 1e-12);
        }
    }
}

// Bends a plant into a circle of the given curvature [1/m]; beyond a full turn it overlaps itself.
void bend(TestCage& cage, double curvature) {
    for (Vec3& place : cage.places) {
        const double angle = curvature * place.y(), radius = 1 / curvature + place.x();
        place.x() = radius * std::cos(angle) - 1 / curvature;
        place.y() = radius * std::sin(angle);
    }
}

TEST(CageContact, EveryLayoutGivesTheSameContacts) {
    const TestCage tree = tree_cage(12, 8, 6);
    Dice dice(1);
    size_t found = 0;
    for (int n = 0; n < 6; ++n) {
        std::vector<TestCage> trees(3, tree);
        std::vector<CollisionBody> bodies;
        for (TestCage& t : trees) {
            bend(t, dice.uniform(4, 14));
            t.turn(dice.rotation());
            t.move(0.1 * Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)));
            bodies.push_back(t.body(bodies.size() != 1));
        }
        const std::vector<CageContact> expected = contacts_of(bodies, {FROND_HASH_LAYOUT_BRUTE_FORCE});
        expect_sound(bodies, expected);
        found += expected.size();
        for (int layout = 0; layout < FROND_HASH_LAYOUT_COUNT; ++layout)
            for (const double cell_size : {0.0, 0.02, 0.07, 0.5})
                for (const int table_size : {0, 7, 4001}) {
                    if (layout == FROND_HASH_LAYOUT_BRUTE_FORCE && (cell_size > 0 || table_size > 0)) continue;
                    const auto contacts = contacts_of(bodies, {frond_hash_layout(layout), table_size, cell_size});
                    ASSERT_EQ(contacts.size(), expected.size()) << hash_row(frond_hash_layout(layout)).name;
                    for (size_t k = 0; k < contacts.size(); ++k) EXPECT_TRUE(same(contacts[k], expected[k]));
                }
    }
    EXPECT_GT(found, 150u);
}

TEST(CageContact, BoundariesThatCrossGiveContacts) {
    Dice dice(2);
    std::array<int, 2> seen = {};
    for (int n = 0; n < 300; ++n) {
        // Rods, blades and blocks, so coarse that they often cross without a node inside.
        const auto random_box = [&] {
            return box_cage(int(dice.uniform(1, 4)), int(dice.uniform(1, 3)), 1,
                            Vec3(dice.uniform(0.2, 1.5), dice.uniform(0.05, 0.8), dice.uniform(0.02, 0.3)));
        };
        TestCage a = random_box(), b = random_box();
        for (TestCage* cage : {&a, &b}) {
            cage->turn(dice.rotation());
            cage->move(0.3 * Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)) - cage->middle());
        }
        const std::vector<CollisionBody> bodies = {a.body(), b.body()};
        const std::vector<CageContact> contacts = contacts_of(bodies);
        expect_sound(bodies, contacts);
        const bool cross = deepest_overlap(a.boundary(), b.boundary()).pairs > 0;
        // If they do not cross, one can still be inside the other.
        EXPECT_TRUE(!cross || !contacts.empty()) << n;
        for (const CageContact& contact : contacts) EXPECT_TRUE(cross || contact.kind == CONTACT_NODE_IN_TET) << n;
        ++seen[cross];
    }
    EXPECT_GT(seen[0], 40);
    EXPECT_GT(seen[1], 100);
}

TEST(CageContact, BladesThatCrossWithoutANodeInsideArePushedApartAtTheirRims) {
    // Rims of two upright blades that overlap by 1 cm: one lies along x above, the other is rotated about y.
    TestCage upper = box_cage(3, 1, 1, {0.6, 0.2, 0.004}), lower = box_cage(3, 1, 1, {0.6, 0.2, 0.004});
    upper.move({-0.27, -0.005, -0.002});
    lower.move({-0.31, -0.195, -0.002});
    lower.turn(Eigen::AngleAxisd(1.1, Vec3::UnitY()).toRotationMatrix());
    const std::vector<CollisionBody> bodies = {upper.body(), lower.body()};
    const std::vector<CageContact> contacts = contacts_of(bodies);
    expect_sound(bodies, contacts);
    ASSERT_FALSE(contacts.empty());
    for (const CageContact& contact : contacts) {
        EXPECT_NE(contact.kind, CONTACT_NODE_IN_TET);
        const double up = contact.normal.y() * (contact.a.body == 0 ? 1 : -1);
        EXPECT_GT(up, 0.99);
        EXPECT_NEAR(contact.depth, 0.01, 1e-3);
    }
    upper.move({0, 0.0101, 0});
    EXPECT_TRUE(contacts_of({upper.body(), lower.body()}).empty());
}

TEST(CageContact, WhatSankDeepComesOutWhereItWentIn) {
    // A block, 0.35 m deep in a slab of 0.5 m: its deepest nodes are nearer to the slab's lower side than to the side
    // where they entered.
    const TestCage ground = box_cage(6, 5, 6, {1.2, 0.5, 1.2});
    TestCage block = box_cage(4, 8, 4, {0.4, 0.8, 0.4});
    block.move({0.41, 0.15, 0.37});
    const std::vector<CollisionBody> bodies = {block.body(), ground.body()};
    const std::vector<CageContact> contacts = contacts_of(bodies);
    expect_sound(bodies, contacts);
    int nodes = 0;
    for (const CageContact& contact : contacts) {
        if (contact.kind != CONTACT_NODE_IN_TET || contact.a.body != 0) continue;
        ++nodes;
        EXPECT_GT(contact.normal.y(), 0.999);
        EXPECT_NEAR(contact.depth, 0.5 - contact.point.y(), 1e-6);
    }
    EXPECT_EQ(nodes, 4 * 25);  // four layers of nodes are below 0.5 m
}

TEST(CageContact, WhatIsWhollyInsideLeavesByTheNearestFace) {
    const TestCage big = box_cage(3, 3, 3, {1, 1, 1});
    TestCage small = box_cage(1, 1, 1, {0.05, 0.05, 0.05});
    small.move({0.9, 0.5, 0.5});
    const std::vector<CageContact> contacts = contacts_of({small.body(), big.body()});
    ASSERT_EQ(contacts.size(), 8u);
    for (const CageContact& contact : contacts) {
        EXPECT_NEAR(contact.normal.x(), 1, 1e-12);
        EXPECT_NEAR(contact.depth, 1 - contact.point.x(), 1e-12);
    }
}

// Turns both and moves a towards b until they overlap by at most 0.02 m. Returns false if they never met.
bool bring_together(TestCage& a, TestCage& b, Dice& dice) {
    constexpr double STEP = 0.02, FAR = 1.2;
    a.move(-a.middle());
    b.move(-b.middle());
    a.turn(dice.rotation());
    b.turn(dice.rotation());
    const Vec3 line = Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)).normalized();
    a.move(FAR * line);
    for (double far = FAR; far > 0; far -= STEP) {
        a.move(-STEP * line);
        if (deepest_overlap(a.boundary(), b.boundary()).pairs > 0) return true;
    }
    return false;
}

TEST(CageContact, ContactsAreAsDeepAsTheDeepestPairOfFaces) {
    // Edges of a node that is inside may reach deeper, under ridges that the node itself is not under.
    Dice dice(11);
    for (int n = 0; n < 60; ++n) {
        const bool blades = n % 2;
        TestCage a = blades ? box_cage(5, 2, 1, {0.8, 0.2, 0.02}) : box_cage(4, 2, 2, {0.8, 0.3, 0.3});
        TestCage b = blades ? box_cage(3, 3, 1, {0.7, 0.3, 0.03}) : box_cage(3, 3, 2, {0.6, 0.5, 0.3});
        ASSERT_TRUE(bring_together(a, b, dice));
        double deepest = 0;
        for (const CageContact& contact : contacts_of({a.body(), b.body()})) deepest = std::max(deepest, contact.depth);
        EXPECT_GE(deepest, deepest_overlap(a.boundary(), b.boundary()).depth - 1e-4) << n;
    }
}

TEST(CageContact, ConvexBodiesComeApartAlongTheirDeepestContacts) {
    Dice dice(3);
    int overlapped = 0;
    for (int n = 0; n < 60; ++n) {
        TestCage a = box_cage(4, 2, 2, {0.8, 0.3, 0.3}), b = box_cage(3, 3, 2, {0.6, 0.5, 0.3});
        const auto crosses = [&] { return deepest_overlap(a.boundary(), b.boundary()).pairs > 0; };
        overlapped += bring_together(a, b, dice);
        Vec3 way = Vec3::Zero();
        for (int k = 0; k < 20; ++k) {
            const std::vector<CageContact> contacts = contacts_of({a.body(), b.body()});
            if (contacts.empty()) break;
            const CageContact* deepest = &contacts[0];
            for (const CageContact& contact : contacts)
                if (contact.depth > deepest->depth) deepest = &contact;
            const Vec3 step = (deepest->a.body == 0 ? 1.0 : -1.0) * (deepest->depth + 1e-9) * deepest->normal;
            a.move(step);
            way += step;
        }
        EXPECT_FALSE(crosses()) << n;
        EXPECT_LT(way.norm(), 0.06) << n;  // they overlapped by at most 0.02 m
    }
    EXPECT_EQ(overlapped, 60);
}

// Moves every node of a cage by up to that much.
void crumple(TestCage& cage, Dice& dice, double most) {
    for (Vec3& place : cage.places)
        for (int c = 0; c < 3; ++c) place[c] += dice.uniform(-most, most);
}

TEST(CageContact, AnEdgeThatHardlyDipsInHasShallowContacts) {
    // It is inside for long, and below ridges of faces that it does not pass through.
    constexpr double STEP = 1e-4, CRUMPLED = 1e-3;
    Dice dice(7);
    for (int n = 0; n < 100; ++n) {
        TestCage bar = box_cage(1, 1, 1, {0.8, 0.1, 0.1}), ground = box_cage(8, 1, 8, {1.2, 0.1, 1.2});
        crumple(ground, dice, CRUMPLED);
        bar.move(-bar.middle());
        ground.move(-ground.middle());
        bar.turn((Eigen::AngleAxisd(dice.uniform(-PI, PI), Vec3::UnitY()) *
                  Eigen::AngleAxisd(dice.uniform(-0.01, 0.01), Vec3::UnitZ()) *
                  Eigen::AngleAxisd(PI / 4, Vec3::UnitX()))
                     .toRotationMatrix());
        bar.move({dice.uniform(-0.1, 0.1), 0.05 + 0.1 / std::sqrt(2.0) - 0.002, dice.uniform(-0.1, 0.1)});
        while (deepest_overlap(bar.boundary(), ground.boundary()).pairs > 0) bar.move({0, STEP, 0});
        for (const double dip : {STEP, 10 * STEP}) {
            bar.move({0, -dip, 0});
            for (const CageContact& contact : contacts_of({bar.body(), ground.body()}))
                EXPECT_LT(contact.depth, 4 * CRUMPLED) << n << ", dips in by " << dip << ", kind " << int(contact.kind);
        }
    }
}

TEST(CageContact, PartsOfAPlantCollideButNotWhereTheyGrowOutOfEachOther) {
    const TestCage tree = tree_cage(12, 8, 6);
    EXPECT_TRUE(contacts_of({tree.body(true)}).empty());
    // Bent a little the plant does not touch itself; rolled up it does, if self-contact is on.
    TestCage bent = tree;
    bend(bent, 0.3);
    EXPECT_TRUE(contacts_of({bent.body(true)}).empty());
    TestCage rolled = tree;
    bend(rolled, 12);
    EXPECT_TRUE(contacts_of({rolled.body(false)}).empty());
    const std::vector<CageContact> contacts = contacts_of({rolled.body(true)});
    EXPECT_FALSE(contacts.empty());
    expect_sound({rolled.body(true)}, contacts);
    // Two halves of a blade that lie on each other at rest do not collide.
    Model doubled = box_model(4, 1, 1, {0.8, 0.2, 0.02});
    const size_t count = doubled.cage.nodes.size();
    for (size_t k = 0; k < count; ++k) doubled.cage.nodes.push_back(doubled.cage.nodes[k] + Vec3(0, 0.1, 0.01));
    for (size_t t = 0, n = doubled.cage.tets.size(); t < n; ++t) {
        Tet tet = doubled.cage.tets[t];
        for (int& node : tet) node += int(count);
        doubled.cage.tets.push_back(tet);
        doubled.cage.tet_organ.push_back(0);
    }
    EXPECT_TRUE(contacts_of({cage_of(doubled, 0, 0.2).body(true)}).empty());
}

TEST(CageContact, ABladeThatFoldsOnItselfIsFound) {
    TestCage blade = box_cage(20, 2, 1, {1, 0.2, 0.01}, 0.1);
    for (Vec3& place : blade.places) {
        // Rolled about an axis along y with a radius that hardly grows, so that the second turn overlaps the first.
        const double radius = 0.1 + place.z() + 0.002 * place.x(), angle = place.x() / 0.1;
        place = Vec3(radius * std::sin(angle), place.y(), radius * std::cos(angle));
    }
    const std::vector<CollisionBody> bodies = {blade.body(true)};
    const std::vector<CageContact> contacts = contacts_of(bodies);
    EXPECT_GT(contacts.size(), 10u);
    expect_sound(bodies, contacts);
}

TEST(CageContact, BodiesWithoutPiecesTakeNoPart) {
    const TestCage box = box_cage(1, 1, 1, {1, 1, 1});
    TestCage other = box;
    other.move({0.1, 0.2, 0.3});
    CollisionBody away = other.body();
    away.pieces.clear();
    EXPECT_TRUE(contacts_of({box.body(), away}).empty());
    EXPECT_FALSE(contacts_of({box.body(), other.body()}).empty());
    EXPECT_TRUE(contacts_of({}).empty());
}

// Not a benchmark: checks that all layouts agree on a scene of the paper's size, and prints what each costs here.
TEST(CageContact, SeventeenPlantsOfTwentyThousandTetsAgreeInEveryLayout) {
    const TestCage tree = tree_cage(30, 20, 10);
    std::vector<TestCage> trees(17, tree);
    std::vector<CollisionBody> bodies;
    Dice dice(4);
    size_t tets = 0;
    for (size_t k = 0; k < trees.size(); ++k) {
        trees[k].turn(Eigen::AngleAxisd(dice.uniform(-3, 3), Vec3::UnitY()).toRotationMatrix());
        trees[k].move(Vec3(0.3 * double(k % 5), 0, 0.3 * double(k / 5)));
        bodies.push_back(trees[k].body());
        tets += tree.collider.tets.size();
    }
    EXPECT_GT(tets, 19000u);
    std::vector<CageContact> expected;
    for (const frond_hash_layout layout : {FROND_HASH_LAYOUT_GRID, FROND_HASH_LAYOUT_PAPER}) {
        const ContactSearchPtr search = make_contact_search();
        OverlapSearch overlaps;
        std::vector<CageContact> contacts;
        double overlap_ms = INFINITY, all_ms = INFINITY;
        for (int n = 0; n < 5; ++n) {
            Timer timer;
            find_overlaps(overlaps, bodies, {layout});
            overlap_ms = std::min(overlap_ms, timer.lap());
            find_cage_contacts(*search, bodies, {layout}, contacts);
            all_ms = std::min(all_ms, timer.lap());
        }
        printf("%zu tets, %s: overlaps %.2f ms, with contacts %.2f ms, %zu contacts\n", tets, hash_row(layout).name,
               overlap_ms, all_ms, contacts.size());
        if (expected.empty()) expected = contacts;
        ASSERT_EQ(contacts.size(), expected.size());
        for (size_t k = 0; k < contacts.size(); ++k) EXPECT_TRUE(same(contacts[k], expected[k]));
    }
    EXPECT_GT(expected.size(), 100u);
}

}  // namespace cage_contact_tests

}  // namespace frond::test
