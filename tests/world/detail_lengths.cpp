// Detail: what moves fast while it is handed over is not drawn out, and its surface does not jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/stand.hpp"

namespace detail_lengths_tests {

using frond::test::capsule_lengths;
using frond::test::edge_lengths;
using frond::test::most_drawn_out;
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
        most = std::max(most, most_drawn_out(plant, own));
    }
    EXPECT_GT(modal_steps, 100);
    EXPECT_LT(most, 1.02);
}

INSTANTIATE_TEST_SUITE_P(Detail, Speeds, testing::Values(0.3, 1.0, 3.0, 6.0));

// A corn's surface, frame by frame.
struct Watched {
    const frond_plant plant;
    frond_surface_view view = {};
    std::vector<double> own;               // lengths of edges that are not tiny [m]
    std::vector<float> last, before_last;  // positions in the frames before [m]

    explicit Watched(frond_plant plant) : plant(plant) {
        must(frond_plant_get_surface(plant, &view));
        own = edge_lengths(plant);
    }
    // Goes on to the next frame. Returns by how much the edge that is drawn out most is.
    double most_drawn_out() {
        constexpr double TINY = 0.004;  // [m]
        before_last.swap(last);
        last.assign(view.positions, view.positions + 3 * view.vertex_count);
        must(frond_plant_get_surface(plant, &view));
        const std::vector<double> now = edge_lengths(plant);
        double most = 0;
        for (size_t k = 0; k < own.size(); k++)
            if (own[k] > TINY) most = std::max(most, now[k] / own[k]);
        return most;
    }
    // Returns the largest change of a vertex' velocity between the last two frames [m/s].
    double largest_jump(double h) const {
        double most = 0;
        for (size_t k = 0; k < last.size(); k++)
            most =
                std::max(most, std::abs(double(view.positions[k]) - 2 * double(last[k]) + double(before_last[k])) / h);
        return most;
    }
};

struct Kick {
    double speed;       // [m/s]
    double rods, cage;  // by how much more than before the surface may be drawn out, by what it becomes [-]
};
class Kicks : public testing::TestWithParam<Kick> {
protected:
    // Kicks a plant, hands it over half a second later and compares what is seen before and after.
    static void hand_over(double from, double to, double bound) {
        const double speed = GetParam().speed;
        Stand stand;
        stand.load_corn();
        const frond_plant plant = stand.add(stand.plant_def(), {0, 0, 0});
        const frond_detail_def detail = frond_default_detail_def();
        must(frond_world_set_detail(stand.world, &detail));
        must(frond_world_set_viewer(stand.world, {from, 1, 0}));
        stand.steps(5);
        Watched watched(plant);
        kick(plant, speed);
        double before = 0, after = 0, jump = 0;
        for (int i = 0; i < 30; i++) {
            stand.steps(1);
            before = std::max(before, watched.most_drawn_out());
        }
        frond_detail then = {}, now = {};
        must(frond_plant_get_detail(plant, &then));
        must(frond_world_set_viewer(stand.world, {to, 1, 0}));
        for (int i = 0; i < 150; i++) {
            stand.steps(1);
            after = std::max(after, watched.most_drawn_out());
            jump = i < 2 ? std::max(jump, watched.largest_jump(stand.h)) : jump;
        }
        must(frond_plant_get_detail(plant, &now));
        EXPECT_NE(then, now);
        EXPECT_LT(after, bound * before);
        EXPECT_LT(jump, speed);
        std::printf("%g m/s: drawn out %.3f before, %.3f after; a vertex' speed jumps by %.2f m/s\n", speed, before,
                    after, jump);
    }
};

TEST_P(Kicks, DrawNoCageOutThatBecomesRods) {
    hand_over(0, 10, GetParam().rods);
}

TEST_P(Kicks, HardlyDrawRodsOutThatBecomeACage) {
    hand_over(10, 0, GetParam().cage);
}

TEST_P(Kicks, LeaveNothingBehindInAPlantThatGoesFar) {
    Stand stand;
    stand.load_corn();
    const frond_plant plant = stand.add(stand.plant_def(), {0, 0, 0});
    const frond_detail_def detail = frond_default_detail_def();
    must(frond_world_set_detail(stand.world, &detail));
    must(frond_world_set_viewer(stand.world, {0, 1, 0}));
    stand.steps(5);
    frond_surface_view view = {};
    must(frond_plant_get_surface(plant, &view));
    const std::vector<float> stood(view.positions, view.positions + 3 * view.vertex_count);
    kick(plant, GetParam().speed);
    stand.steps(30);
    must(frond_world_set_viewer(stand.world, {detail.modal_from + 1, 1, 0}));
    stand.steps(900);
    must(frond_plant_get_surface(plant, &view));
    float most = 0;
    for (size_t k = 0; k < stood.size(); k++) most = std::max(most, std::abs(view.positions[k] - stood[k]));
    EXPECT_LT(most, 0.001f);
}

INSTANTIATE_TEST_SUITE_P(Detail, Kicks,
                         testing::Values(Kick{0.3, 1.05, 1.15}, Kick{1, 1.05, 1.3}, Kick{3, 1.2, 1.65},
                                         Kick{6, 1.2, 2.2}));

}  // namespace detail_lengths_tests
