// What tets hold of each organ.
#include <gtest/gtest.h>

#include <random>

#include "cage/cage.hpp"
#include "cage/shift_centre.hpp"
#include "cage/tet_geometry.hpp"
#include "support/materials.hpp"
#include "support/soups.hpp"

namespace frond::test {

TEST(CageTissue, IsThatOfEachOrganAndWhereThatIs) {
    Surface surface;
    add_tube(surface, {0, 0, 0}, 0.01, 1, 8, 20, true, 0);
    add_sheet(
        surface, 20, 3, [](double s, double t) { return Vec3(0.8 * s, 0.7, 0.1 * (t - 0.5)); }, 1);
    const std::vector<Organ> organs = {{"plant", "stem", plain_material(1000, 1e8, 0.3, 1e-3)},
                                       {"leaf", "blade", plain_material(800, 1e7, 0.3, 3e-4)}};
    const double tube = 0.5 * 8 * 0.01 * 0.01 * std::sin(2 * M_PI / 8), sheet = 0.8 * 0.1 * 3e-4;
    for (const double cell : {0.03, 0.1, 0.3}) {
        SCOPED_TRACE(cell);
        Cage cage;
        Embedding embedding;
        make_cage(surface, make_topology(surface), organs, {cell, 0, 0.5}, cage, embedding);
        std::array<double, 2> volume = {};
        std::array<Vec3, 2> moment = {Vec3::Zero(), Vec3::Zero()};
        for (const Tissue& part : cage.tissue) {
            EXPECT_GT(part.volume, 0);
            volume[size_t(part.organ)] += part.volume;
            moment[size_t(part.organ)] += part.volume * tet_centre(cage.nodes, cage.tets[size_t(part.tet)]);
        }
        EXPECT_NEAR(volume[0], tube, 1e-9 * tube);
        EXPECT_NEAR(volume[1], sheet, 1e-9 * sheet);
        double fill = 0;
        for (size_t e = 0; e < cage.tets.size(); ++e) fill += cage.tet_fill[e] * tet_volume(cage.nodes, cage.tets[e]);
        EXPECT_NEAR(fill, tube + sheet, 1e-9 * tube);
        ASSERT_EQ(cage.organ_centre.size(), 2u);
        EXPECT_LT((cage.organ_centre[0] - Vec3(0, 0.5, 0)).norm(), 1e-9);
        EXPECT_LT((cage.organ_centre[1] - Vec3(0.4, 0.7, 0)).norm(), 1e-9);
        for (size_t o = 0; o < 2; ++o)
            EXPECT_LT((moment[o] / volume[o] - cage.organ_centre[o]).norm(), 0.03 * cell) << organs[o].name;
    }
}

TEST(ShiftCentre, BringsItWhereItIsWantedAndNoFartherThanPlacesAllow) {
    std::mt19937_64 engine(5);
    const auto any = [&] { return double(engine() % 2001) / 1000 - 1; };
    std::vector<Vec3> places;
    std::vector<double> masses;
    for (int i = 0; i < 100; ++i) {
        places.push_back({any(), any(), any()});
        masses.push_back(1.5 + any());
    }
    const auto centre = [&] {
        Vec3 sum = Vec3::Zero();
        double mass = 0;
        for (size_t i = 0; i < places.size(); ++i) {
            sum += masses[i] * places[i];
            mass += masses[i];
            EXPECT_GT(masses[i], 0);
        }
        return Vec3(sum / mass);
    };
    shift_centre(places, {0.2, -0.1, 0.3}, masses);
    EXPECT_LT((centre() - Vec3(0.2, -0.1, 0.3)).norm(), 1e-3);
    // Beside a line it comes to the nearest place on it.
    for (size_t i = 0; i < places.size(); ++i) places[i] = {any(), 0, 0};
    masses.assign(places.size(), 1);
    shift_centre(places, {0.3, 0.1, 0}, masses);
    EXPECT_LT((centre() - Vec3(0.3, 0, 0)).norm(), 1e-3);
    for (double& mass : masses) mass = 1;
    shift_centre(places, {0, 5, 0}, masses);
    for (double mass : masses) EXPECT_NEAR(mass, 1, 0.5);
}

}  // namespace frond::test
