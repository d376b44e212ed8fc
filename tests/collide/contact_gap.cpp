// Contacts that are followed: to the points where the two are nearest now, within the reach of the old ones, and only
// on the same side.
#include "collide/contact_gap.hpp"

#include <gtest/gtest.h>

#include "support/cages.hpp"

namespace frond::test {
namespace contact_gap_tests {

constexpr double REACH = 0.01, IN = 0.002;  // [m]

// A block that overlaps a slab slightly; the slab is body 1.
struct BlockOnSlab {
    TestCage block = box_cage(1, 1, 1, Vec3(0.1, 0.1, 0.1)), slab = box_cage(4, 1, 4, Vec3(0.4, 0.1, 0.4));
    BlockOnSlab() { block.move(Vec3(0.15, 0.1 - IN, 0.15)); }
    std::vector<CollisionBody> bodies() const { return {block.body(), slab.body()}; }
    bool follow(CageContact& contact) const { return follow_contact(block.body(), slab.body(), REACH, contact); }
    // Returns the contact of a corner of the block, as the search finds it.
    CageContact corner() const {
        for (const CageContact& contact : contacts_of(bodies()))
            if (contact.kind == CONTACT_NODE_IN_TET && contact.a.body == 0 && contact.normal.y() > 0.99) return contact;
        ADD_FAILURE() << "no corner is in the slab";
        return {};
    }
    // Returns a contact of a lower edge of the block, at a share of its length, in the middle of the slab's top.
    CageContact edge(double along) const {
        CageContact contact = corner();
        for (const auto& [begin, end] : block.collider.edges) {
            const Vec3 &from = block.places[size_t(begin)], &to = block.places[size_t(end)];
            if (from.y() > 0.1 || to.y() > 0.1 || std::abs(std::abs(to.x() - from.x()) - 0.1) > 1e-9 ||
                from.z() != to.z())
                continue;
            contact.kind = CONTACT_EDGE_IN_FACE;
            contact.a.node_count = 2;
            contact.a.nodes = {begin, end, 0, 0};
            contact.a.weights = {1 - along, along, 0, 0};
            contact.point = from + along * (to - from);
            return contact;
        }
        ADD_FAILURE() << "no edge lies on the slab";
        return contact;
    }
};

TEST(ContactGap, IsThatOfTheNearestPlaceAfterBothHaveMoved) {
    for (const double up : {0.0, 0.001, 0.006}) {
        BlockOnSlab scene;
        CageContact contact = scene.corner();
        EXPECT_NEAR(contact.depth, IN, 1e-9);
        scene.block.move(Vec3(0.03, up, -0.02));
        ASSERT_TRUE(scene.follow(contact)) << up;
        EXPECT_NEAR(contact.depth, IN - up, 1e-9) << up;
        EXPECT_NEAR(contact.normal.y(), 1, 1e-9) << up;
        const Vec3 a = place_of(scene.bodies(), contact.a), b = place_of(scene.bodies(), contact.b);
        EXPECT_LT((contact.point - a).norm(), 1e-12);
        EXPECT_LT((b - a - contact.depth * contact.normal).norm(), 1e-9);
    }
}

TEST(ContactGap, EndsWhereTheOtherIsOutOfReachOrLiesAnotherWayRound) {
    BlockOnSlab scene;
    CageContact contact = scene.corner();
    const double depth = contact.depth;
    scene.block.move(Vec3(0, IN + 1.1 * REACH, 0));
    EXPECT_FALSE(scene.follow(contact));
    scene.block.move(Vec3(0, -1.1 * REACH, 0));
    contact.normal = -contact.normal;
    EXPECT_FALSE(scene.follow(contact));
    EXPECT_EQ(contact.depth, depth);
}

// All points along the edge are equally near: a contact stays about where it was.
TEST(ContactGap, DoesNotSlideFarAlongAnEdgeThatLiesFlat) {
    for (const double along : {0.3, 0.5, 0.7}) {
        BlockOnSlab scene;
        CageContact contact = scene.edge(along);
        scene.block.move(Vec3(0, IN + 0.001, 0));
        ASSERT_TRUE(scene.follow(contact));
        EXPECT_NEAR(contact.depth, -0.001, 1e-9);
        EXPECT_NEAR(contact.a.weights[1], along, 0.1 + 1e-9);  // 1 cm of 10
    }
}

}  // namespace contact_gap_tests

}  // namespace frond::test
