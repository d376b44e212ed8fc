// Detail: what moves fast while it is handed over to two modes keeps the lengths of its capsules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/stand.hpp"

namespace detail_lengths_tests {

using frond::test::capsule_lengths;
using frond::test::must;
using frond::test::Stand;

// Has all nodes of a plant move along x, the faster the higher they are.
void kick(frond_plant plant, double speed) {
    const int count = frond_plant_get_node_count(plant);
    std::vector<frond_vec3> x(static_cast<size_t>(count)), v(x.size());
    must(frond_plant_get_state(plant, &x[0].x, &v[0].x, count));
    double height = 0;
    for (const frond_vec3& at : x) height = std::max(height, at.y);
    for (size_t i = 0; i < x.size(); i++) v[i].x += speed * std::max(x[i].y, 0.0) / height;
    must(frond_plant_set_state(plant, nullptr, &v[0].x, count));
}

class Speeds : public testing::TestWithParam<double> {};

TEST_P(Speeds, AreHandedOverWithoutDrawingCapsulesOut) {
    Stand stand;
    stand.load_corn();
    frond_plant_def def = stand.plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    const frond_plant plant = stand.add(def, {0, 0, 0}, 2);
    const std::vector<double> own = capsule_lengths(plant);
    kick(plant, GetParam());
    const frond_detail_def detail = frond_default_detail_def();
    must(frond_world_set_detail(stand.world, &detail));
    must(frond_world_set_viewer(stand.world, {detail.modal_from + 1, 1, 0}));
    double most = 0;
    int modal_steps = 0;
    for (int i = 0; i < 180; i++) {
        must(frond_world_step(stand.world, stand.h));
        frond_detail now = {};
        must(frond_plant_get_detail(plant, &now));
        modal_steps += now == FROND_DETAIL_MODAL;
        const std::vector<double> lengths = capsule_lengths(plant);
        for (size_t k = 0; k < own.size(); k++) most = std::max(most, lengths[k] / own[k]);
    }
    EXPECT_GT(modal_steps, 100);
    EXPECT_LT(most, 1.02);
}

INSTANTIATE_TEST_SUITE_P(Detail, Speeds, testing::Values(0.3, 1.0, 3.0, 6.0));

}  // namespace detail_lengths_tests
