// Tets that are held firmly, and tets that turn about a hinge.
#include "calibration/firm_tets.hpp"

#include <gtest/gtest.h>

using namespace frond;

// Returns a tet, one that shares a face with it, one that shares an edge with that, and one that shares a node.
static Cage four_tets() {
    Cage cage;
    cage.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},  {0, 0, 1},   {1, 1, 1},
                  {2, 1, 2}, {3, 1, 1}, {0, 0, -1}, {0, -1, -1}, {-1, 0, -1}};
    cage.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}, {3, 4, 5, 6}, {0, 7, 8, 9}};
    return cage;
}

static std::vector<uint8_t> hold(std::initializer_list<int> nodes) {
    std::vector<uint8_t> held(10, 0);
    for (int node : nodes) held[size_t(node)] = 1;
    return held;
}

TEST(FirmTets, AreThoseThatWholeFacesTieToThreeHeldNodes) {
    EXPECT_EQ(find_firm_tets(four_tets(), hold({0, 1, 2})), (std::vector<char>{1, 1, 0, 0}));
}

TEST(FirmTets, NeedMoreThanAnEdge) {
    EXPECT_EQ(find_firm_tets(four_tets(), hold({0, 1})), (std::vector<char>{0, 0, 0, 0}));
}

TEST(FirmTets, MayBeHeldByAHingeAndAThirdNode) {
    EXPECT_EQ(find_firm_tets(four_tets(), hold({0, 1, 2, 6})), (std::vector<char>{1, 1, 1, 0}));
}

TEST(FirmTets, AreNotHeldByThreeNodesOnALine) {
    Cage cage = four_tets();
    cage.nodes[2] = {2, 0, 0};
    cage.tets = {{0, 3, 1, 4}, {2, 3, 1, 4}};
    EXPECT_EQ(find_firm_tets(cage, hold({0, 1, 2})), (std::vector<char>{0, 0}));
}
