// Covers: capsules contain their regions of a cage, and the regions whose capsules meet have all contacts.
#include "collide/cover.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "support/cages.hpp"

namespace frond::test {
namespace cover_tests {

// Returns the axes of the regions, into which the test's stem is cut by height.
std::vector<Axis> axes_of(const TestCage& cage, const std::function<Vec3(const Vec3&)>& moved) {
    std::vector<Axis> axes;
    for (int p = 0; p < cage.collider.piece_count; ++p)
        axes.push_back({moved({0.015, 0.2 * p, 0.015}), moved({0.015, 0.2 * (p + 1), 0.015})});
    return axes;
}

struct Covered {
    TestCage cage;
    std::vector<Capsule> capsules;
    CoveredBody body(bool with_itself) const { return {&cage.collider, &capsules, with_itself}; }
};

Covered cover(const TestCage& cage, const Mat3& rotation, const Vec3& by) {
    Covered covered = {cage, {}};
    covered.cage.turn(rotation);
    covered.cage.move(by);
    covered.capsules = cover_pieces(cage.collider, covered.cage.places.data(),
                                    axes_of(cage, [&](const Vec3& p) { return Vec3(rotation * p + by); }));
    return covered;
}

TEST(Cover, CapsulesHoldTheNodesOfTheirPiecesAndNoMore) {
    const Covered tree = cover(tree_cage(12, 8, 6), Mat3::Identity(), Vec3(3, 0, 1));
    ASSERT_EQ(int(tree.capsules.size()), tree.cage.collider.piece_count);
    for (int p = 0; p < tree.cage.collider.piece_count; ++p) {
        const Capsule& capsule = tree.capsules[size_t(p)];
        double farthest = -INFINITY;
        for (const int n : tree.cage.collider.piece_nodes[p]) {
            const Vec3& place = tree.cage.places[size_t(n)];
            farthest = std::max(farthest, gap_between(Capsule{place, place, 0}, capsule).distance);
        }
        EXPECT_NEAR(farthest, 0, 1e-12);
    }
}

TEST(Cover, PiecesThatMeetHaveAllContacts) {
    const TestCage tree = tree_cage(12, 8, 6);
    Dice dice(1);
    int smaller = 0, with_contacts = 0;
    for (int n = 0; n < 60; ++n) {
        std::vector<Covered> trees;
        for (int k = 0; k < 3; ++k)
            trees.push_back(cover(tree, dice.rotation(),
                                  0.55 * Vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1))));
        std::vector<CoveredBody> covered;
        for (const Covered& t : trees) covered.push_back(t.body(true));
        const std::vector<std::vector<uint8_t>> pieces = find_meeting_pieces(covered, 0);
        std::vector<CollisionBody> all, meeting;
        for (size_t k = 0; k < 3; ++k) {
            all.push_back(trees[k].cage.body(true));
            meeting.push_back(trees[k].cage.body(true));
            meeting.back().pieces = pieces[k];
            for (const uint8_t takes_part : pieces[k]) smaller += !takes_part;
        }
        const size_t count = contacts_of(all).size();
        EXPECT_EQ(contacts_of(meeting).size(), count);
        with_contacts += count > 0;
    }
    EXPECT_GT(smaller, 10);
    EXPECT_GT(with_contacts, 10);
}

TEST(Cover, APlantThatNothingIsNearHasNoPieces) {
    const TestCage tree = tree_cage(12, 8, 6);
    const Covered a = cover(tree, Mat3::Identity(), Vec3::Zero()), b = cover(tree, Mat3::Identity(), Vec3(0.2, 0, 0)),
                  c = cover(tree, Mat3::Identity(), Vec3(5, 0, 0));
    const auto pieces = find_meeting_pieces({a.body(false), b.body(false), c.body(false)}, 0.01);
    EXPECT_FALSE(pieces[0].empty());
    EXPECT_FALSE(pieces[1].empty());
    EXPECT_TRUE(pieces[2].empty());
    // The margin is taken into account.
    EXPECT_FALSE(find_meeting_pieces({a.body(false), c.body(false)}, 5)[0].empty());
    // Without bodies, nothing meets.
    EXPECT_TRUE(find_meeting_pieces({}, 0.01).empty());
}

}  // namespace cover_tests

}  // namespace frond::test
