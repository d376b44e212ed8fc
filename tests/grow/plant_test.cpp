// Grown plants: exact counts, sound triangles, and organs that are connected but do not cross others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "grow/grow.hpp"

namespace frond::grow {
namespace plant_test_tests {

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Returns the plant with the rounded numbers that a reader of the OBJ file gets.
GrownPlant rounded(GrownPlant plant) {
    for (Point& p : plant.positions)
        for (double& x : p) x = std::round(x * 1e5) / 1e5;
    return plant;
}

// Returns whether the edge from p to q passes through the triangle (Moeller, Trumbore 1997).
bool edge_passes(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c) {
    const Point d = minus(q, p), e1 = minus(b, a), e2 = minus(c, a), h = cross(d, e2);
    const double det = dot(e1, h);
    if (std::fabs(det) < 1e-18) return false;
    const Point s = minus(p, a);
    const double u = dot(s, h) / det;
    const Point k = cross(s, e1);
    const double v = dot(d, k) / det, t = dot(e2, k) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

struct Box {
    Point low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    void add(const Point& p) {
        for (int k = 0; k < 3; k++) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
    bool meets(const Box& other) const {
        for (int k = 0; k < 3; k++)
            if (low[k] > other.high[k] || high[k] < other.low[k]) return false;
        return true;
    }
};

// Returns the pairs of organs whose triangles cross.
std::set<std::pair<std::string, std::string>> crossings(const GrownPlant& plant) {
    std::vector<Box> triangles(plant.triangles.size()), organs(plant.organs.size());
    for (size_t o = 0; o < plant.organs.size(); o++) {
        const GrownOrgan& organ = plant.organs[o];
        for (int t = organ.first_triangle; t < organ.first_triangle + organ.triangle_count; t++)
            for (int v : plant.triangles[t]) triangles[t].add(plant.positions[v]), organs[o].add(plant.positions[v]);
    }
    auto cross_at = [&](int s, int t) {
        const auto &a = plant.triangles[s], &b = plant.triangles[t];
        const auto& p = plant.positions;
        for (int k = 0; k < 3; k++) {
            if (edge_passes(p[a[k]], p[a[(k + 1) % 3]], p[b[0]], p[b[1]], p[b[2]])) return true;
            if (edge_passes(p[b[k]], p[b[(k + 1) % 3]], p[a[0]], p[a[1]], p[a[2]])) return true;
        }
        return false;
    };
    auto organs_cross = [&](size_t i, size_t j) {
        // Only triangles that reach into the other organ's box matter.
        std::vector<int> near_j;
        const GrownOrgan &a = plant.organs[i], &b = plant.organs[j];
        for (int t = b.first_triangle; t < b.first_triangle + b.triangle_count; t++)
            if (triangles[t].meets(organs[i])) near_j.push_back(t);
        for (int s = a.first_triangle; s < a.first_triangle + a.triangle_count; s++) {
            if (!triangles[s].meets(organs[j])) continue;
            for (int t : near_j)
                if (triangles[s].meets(triangles[t]) && cross_at(s, t)) return true;
        }
        return false;
    };
    std::set<std::pair<std::string, std::string>> found;
    for (size_t i = 0; i < plant.organs.size(); i++)
        for (size_t j = i + 1; j < plant.organs.size(); j++)
            if (organs[i].meets(organs[j]) && organs_cross(i, j))
                found.insert({plant.organs[i].name, plant.organs[j].name});
    return found;
}

std::string without_number(const std::string& name) {
    return name.substr(0, name.find_last_not_of("_0123456789") + 1);
}
std::string number_of(const std::string& name) {
    return name.substr(name.find_last_not_of("0123456789") + 1);
}

Box box_of(const GrownPlant& plant) {
    Box box;
    for (const Point& p : plant.positions) box.add(p);
    return box;
}

TEST(GrownCorn, HasThePapersCounts) {
    const GrownPlant plant = grow_plant("corn");
    EXPECT_EQ(plant.positions.size(), 925u);
    EXPECT_EQ(plant.triangles.size(), 1184u);
}

TEST(GrownCucumber, HasThePapersCountsAndHeight) {
    const GrownPlant plant = grow_plant("cucumber");
    EXPECT_EQ(plant.positions.size(), 22004u);
    EXPECT_EQ(plant.triangles.size(), 30244u);
    // The stake is higher than the plant.
    double top = -1, stake_top = -1;
    for (const GrownOrgan& organ : plant.organs)
        for (int v = organ.first_vertex; v < organ.first_vertex + organ.vertex_count; v++) {
            double& highest = organ.name == "stake" ? stake_top : top;
            highest = std::max(highest, plant.positions[v][1]);
        }
    EXPECT_NEAR(top, 2.10, 1e-9);
    EXPECT_NEAR(stake_top, 2.13, 0.02);
}

// The twine shares corners with stem and stake, so that the three are one connected component.
TEST(GrownCucumber, IsTiedToItsStakeFromTheGroundToTheTop) {
    const GrownPlant plant = rounded(grow_plant("cucumber"));
    std::map<std::string, std::set<Point>> places;
    for (const GrownOrgan& organ : plant.organs)
        for (int v = organ.first_vertex; v < organ.first_vertex + organ.vertex_count; v++)
            places[organ.name].insert(plant.positions[v]);
    const auto share = [&](const std::string& a, const std::string& b) {
        return std::any_of(places[a].begin(), places[a].end(), [&](const Point& p) { return places[b].count(p) > 0; });
    };
    double before = 0;
    int ties = 0;
    for (const GrownOrgan& organ : plant.organs) {
        if (without_number(organ.name) != "tie") continue;
        ties++;
        EXPECT_TRUE(share(organ.name, "stem") && share(organ.name, "stake")) << organ.name;
        const double height = plant.positions[organ.first_vertex][1];
        EXPECT_GT(height, before) << organ.name;
        EXPECT_LT(height, before + 0.35) << organ.name;
        before = height;
    }
    EXPECT_EQ(ties, 9);
    EXPECT_GT(before, 1.75);
    EXPECT_FALSE(share("stem", "stake"));
}

TEST(GrownPlants, SettingsAndSeedsMoveVerticesButKeepTheCounts) {
    for (const GrownKind& kind : grown_kinds()) {
        const GrownPlant plain = grow_plant(kind.name);
        for (const GrownParameter& parameter : kind.parameters) {
            if (parameter.name == std::string("leaves")) continue;
            for (double value : {parameter.low, parameter.high}) {
                const GrownPlant other = grow_plant(kind.name, {{parameter.name, value}}, 5);
                EXPECT_EQ(other.positions.size(), plain.positions.size()) << kind.name << " " << parameter.name;
                EXPECT_EQ(other.triangles, plain.triangles) << kind.name << " " << parameter.name;
                EXPECT_NE(other.positions, grow_plant(kind.name, {}, 5).positions)
                    << kind.name << " " << parameter.name;
                for (const Point& p : other.positions) ASSERT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
            }
        }
    }
}

// 18000 leaves: the size of the largest in the literature on simulated trees (Zhao, Barbič 2013).
TEST(GrownTree, HasAsManyLeavesAsItIsAskedFor) {
    for (int leaves : {100, 1800, 18000}) {
        const GrownPlant tree = grow_plant("tree", {{"leaves", leaves}});
        const auto is_leaf = [](const GrownOrgan& organ) { return organ.name.rfind("leaf_", 0) == 0; };
        EXPECT_EQ(std::count_if(tree.organs.begin(), tree.organs.end(), is_leaf), leaves);
        EXPECT_NEAR(double(tree.triangles.size()), 16.0 * leaves, 2.0 * leaves + 2000);
    }
}

TEST(GrownPlants, TheSameSeedGivesTheSamePlantAndAnotherSeedAnother) {
    for (const GrownKind& kind : grown_kinds()) {
        EXPECT_EQ(grow_plant(kind.name, {}, 3).positions, grow_plant(kind.name, {}, 3).positions);
        EXPECT_NE(grow_plant(kind.name, {}, 3).positions, grow_plant(kind.name, {}, 4).positions);
    }
}

TEST(GrownPlants, StandOnTheGroundInMetres) {
    for (const GrownKind& kind : grown_kinds()) {
        const Box box = box_of(grow_plant(kind.name));
        EXPECT_LE(box.low[1], 0) << kind.name;
        EXPECT_GT(box.low[1], -0.05) << kind.name;
        for (int k : {0, 2}) EXPECT_LT(box.low[k] * box.high[k], 0) << kind.name << " does not stand over the origin";
    }
}

TEST(GrownPlants, EveryVertexIsUsedAndNoneIsDoubledWithinItsOrgan) {
    for (const GrownKind& kind : grown_kinds()) {
        const GrownPlant plant = rounded(grow_plant(kind.name));
        std::vector<bool> used(plant.positions.size());
        for (const auto& t : plant.triangles)
            for (int v : t) used.at(v) = true;
        EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << kind.name;
        for (const GrownOrgan& organ : plant.organs) {
            std::set<Point> places;
            for (int v = organ.first_vertex; v < organ.first_vertex + organ.vertex_count; v++)
                EXPECT_TRUE(places.insert(plant.positions[v]).second) << kind.name << " " << organ.name;
        }
    }
}

TEST(GrownPlants, OrgansCoverAllVerticesAndTrianglesAndHaveOneNameEach) {
    for (const GrownKind& kind : grown_kinds()) {
        const GrownPlant plant = grow_plant(kind.name);
        std::set<std::string> names;
        int vertex = 0, triangle = 0;
        for (const GrownOrgan& organ : plant.organs) {
            EXPECT_TRUE(names.insert(organ.name).second) << organ.name;
            EXPECT_EQ(organ.first_vertex, vertex);
            EXPECT_EQ(organ.first_triangle, triangle);
            vertex += organ.vertex_count, triangle += organ.triangle_count;
            for (int t = organ.first_triangle; t < triangle; t++)
                for (int v : plant.triangles[t]) EXPECT_TRUE(v >= organ.first_vertex && v < vertex) << organ.name;
        }
        EXPECT_EQ(vertex, static_cast<int>(plant.positions.size()));
        EXPECT_EQ(triangle, static_cast<int>(plant.triangles.size()));
    }
}

TEST(GrownPlants, NoTriangleIsDegenerateOrGivenTwice) {
    for (const GrownKind& kind : grown_kinds()) {
        const GrownPlant plant = rounded(grow_plant(kind.name));
        std::set<std::array<int, 3>> seen;
        for (const auto& t : plant.triangles) {
            const Point& a = plant.positions[t[0]];
            const Point n = cross(minus(plant.positions[t[1]], a), minus(plant.positions[t[2]], a));
            EXPECT_GT(std::sqrt(dot(n, n)) / 2, 1e-8) << kind.name;  // [m^2]
            std::array<int, 3> sorted = t;
            std::sort(sorted.begin(), sorted.end());
            EXPECT_TRUE(seen.insert(sorted).second) << kind.name;
        }
    }
}

TEST(GrownPlants, EveryOrganHangsOnTheStem) {
    for (const GrownKind& kind : grown_kinds()) {
        const GrownPlant plant = rounded(grow_plant(kind.name));
        const auto pairs = crossings(plant);
        // Spread from the stem over touching organs.
        std::set<std::string> held{kind.name == std::string("tree") ? "trunk" : "stem"};
        for (size_t before = 0; before != held.size();) {
            before = held.size();
            for (const auto& [a, b] : pairs)
                if (held.count(a) || held.count(b)) held.insert(a), held.insert(b);
        }
        for (const GrownOrgan& organ : plant.organs)
            EXPECT_TRUE(held.count(organ.name)) << kind.name << " " << organ.name;
    }
}

TEST(GrownPlants, OrgansCrossOnlyWhereTheyAreAttached) {
    // Kinds of organs that may touch; except for the stem, each only its own partner: leaf_3 sits on petiole_3.
    const std::set<std::pair<std::string, std::string>> attached = {
        {"petiole", "leaf"}, {"peduncle", "fruit"}, {"fruit", "flower_fruit"}, {"ear", "silk"}};
    for (const char* kind : {"corn", "cucumber"}) {
        for (const auto& [a, b] : crossings(rounded(grow_plant(kind)))) {
            if (a == "stem" && b.rfind("flower_fruit", 0) != 0) continue;
            if (a == "stake" && without_number(b) == "tie") continue;
            EXPECT_TRUE(attached.count({without_number(a), without_number(b)}) && number_of(a) == number_of(b))
                << kind << ": " << a << " crosses " << b;
        }
    }
}

}  // namespace plant_test_tests

}  // namespace frond::grow
