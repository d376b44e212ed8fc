// The same plants drawn otherwise: mirrored, turned, with faces turned over or drawn twice, jittered, as a soup,
// damaged.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>

#include "corpus.hpp"

namespace frond::test {

using Change = std::function<void(Surface&, std::mt19937&)>;

static Vec3 random_step(double reach, std::mt19937& random) {
    std::uniform_real_distribution<double> step(-reach, reach);
    const double x = step(random), y = step(random);
    return {x, y, step(random)};
}

static void turn_over(Triangle& corners) {
    std::swap(corners[0], corners[1]);
}

static void mirror(Surface& surface, std::mt19937&) {
    for (Vec3& place : surface.positions) place.x() = -place.x();
    for (Triangle& corners : surface.triangles) turn_over(corners);
}

static void turn(Surface& surface, std::mt19937&) {
    const Eigen::AngleAxisd about(0.6, Vec3::UnitY());
    for (Vec3& place : surface.positions) place = about * place;
}

static void turn_some_over(Surface& surface, std::mt19937& random) {
    for (Triangle& corners : surface.triangles)
        if (random() % 2) turn_over(corners);
}

// Draws every triangle both ways round.
static void draw_twice(Surface& surface, std::mt19937&) {
    std::vector<Triangle> both;
    for (Triangle corners : surface.triangles) {
        both.push_back(corners);
        turn_over(corners);
        both.push_back(corners);
    }
    surface.triangles = both;
    for (Part& part : surface.parts) {
        part.first_triangle *= 2;
        part.triangle_count *= 2;
    }
}

static void jitter(Surface& surface, std::mt19937& random) {
    const double reach = 1e-4 * surface.size();
    std::map<std::array<double, 3>, Vec3> moved;  // vertices in one place stay together
    for (Vec3& place : surface.positions) {
        const std::array<double, 3> key = {place.x(), place.y(), place.z()};
        const auto at = moved.find(key);
        if (at == moved.end())
            place = moved.emplace(key, place + random_step(reach, random)).first->second;
        else
            place = at->second;
    }
}

// Gives each triangle corners of its own, that differ by 1e-5 of the size.
static void tear_apart(Surface& surface, std::mt19937& random) {
    const double reach = 1e-5 * surface.size();
    const std::vector<Vec3> places = surface.positions;
    surface.positions.clear();
    surface.normals.clear();
    surface.uvs.clear();
    surface.colors.clear();
    for (Triangle& corners : surface.triangles)
        for (int& corner : corners) {
            surface.positions.push_back(places[size_t(corner)] + random_step(reach, random));
            corner = int(surface.positions.size()) - 1;
        }
}

static void lose_some(Surface& surface, std::mt19937& random) {
    std::vector<Triangle> kept;
    for (Part& part : surface.parts) {
        const auto from = surface.triangles.begin() + part.first_triangle;
        part.first_triangle = int(kept.size());
        for (auto at = from; at != from + part.triangle_count; ++at)
            if (random() % 20) kept.push_back(*at);
        part.triangle_count = int(kept.size()) - part.first_triangle;
    }
    surface.triangles = kept;
}

class Variants : public testing::TestWithParam<int> {};

static const struct {
    const char* name;
    Change change;
    double kinds, leaves;  // least shares that are right
} CHANGES[] = {
    {"mirrored", mirror, 0.88, 0.85},
    {"turned", turn, 0.88, 0.85},
    {"turned_over", turn_some_over, 0.88, 0.85},
    {"drawn_twice", draw_twice, 0.9, 0.85},
    {"jittered", jitter, 0.88, 0.85},
    {"torn_apart", tear_apart, 0.88, 0.85},
    {"five_percent_lost", lose_some, 0.75, 0.6},
};

TEST_P(Variants, HaveTheSameOrgans) {
    const auto& one = CHANGES[GetParam()];
    for (bool bare : {false, true}) {
        double kinds = 0, leaves = 0;
        const std::vector<Row> rows = read_seen();
        for (const Row& row : rows) {
            std::mt19937 random(7);
            Surface surface = load(row, bare);
            one.change(surface, random);
            const Score score = compare(row, find(row, std::move(surface)).counts);
            kinds += double(score.right) / std::max(1, score.all) / double(rows.size());
            leaves += double(score.leaves) / double(rows.size());
        }
        std::printf("%s, %s: kinds right %.3f, count of leaves %.3f\n", one.name, bare ? "bare" : "as they are", kinds,
                    leaves);
        EXPECT_GT(kinds, one.kinds);
        EXPECT_GT(leaves, one.leaves);
    }
}

INSTANTIATE_TEST_SUITE_P(Corpus, Variants, testing::Range(0, int(std::size(CHANGES))),
                         [](const auto& info) { return std::string(CHANGES[info.param].name); });

}  // namespace frond::test
