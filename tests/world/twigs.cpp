// Stems with twigs as rods, at whose tips forces pull: twigs turn far within a step, and keep their lengths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/lengths.hpp"
#include "support/meshes.hpp"
#include "support/stand.hpp"

namespace frond::test {
namespace twigs_tests {

// A random stem with a thinner twig at its top, and a force at the twig's tip.
struct Twig {
    std::vector<frond_stem> stems;
    double young, strain;  // [Pa], of the tip by the force at rest [-]
    Vec3 force;            // [N]
};
Twig make_twig(Dice& dice) {
    const double length = dice.uniform(0.1, 1), foot = length / dice.uniform(40, 340),
                 top = foot * dice.uniform(0.3, 1), twig = length * dice.uniform(0.2, 0.5),
                 begin = top * dice.uniform(0.2, 0.7), tip = begin * dice.uniform(0.4, 0.9);
    const double young = 1e7 * std::pow(100, dice.uniform(0, 1)), strain = 1e-3 * std::pow(100, dice.uniform(0, 1));
    return {{{-1, {0, 0, 0}, {0, length, 0}, foot, top}, {0, {0, length, 0}, {twig, 1.1 * length, 0}, begin, tip}},
            young,
            strain,
            strain * young * M_PI * tip * tip * dice.rotation().col(0)};
}

// Returns by how much the force draws out a segment at most, over its length, in six steps of h [s].
double most_stretch(const Twig& twig, frond_integrator integrator, double h) {
    Stand stand(weightless(h));
    stand.h = h;
    stand.make_stems(twig.stems, twig.young);
    frond_plant_def def = stand.plant_def();
    def.mechanics = FROND_MECHANICS_ROD;
    def.integrator = integrator;
    def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    const frond_plant plant = stand.add(def, {0, 0, 0});
    const std::vector<double> before = capsule_lengths(plant);
    double most = 0;
    for (int step = 0; step < 6; step++) {
        must(frond_plant_add_force(plant, frond_plant_get_node_count(plant) - 1,
                                   {twig.force.x(), twig.force.y(), twig.force.z()}));
        stand.steps(1);
        most = std::max(most, most_drawn_out(plant, before) - 1);
    }
    return most;
}

// What swings about under a constant force is drawn by three times that force at most.
TEST(Twigs, KeepTheirLengthsHoweverFarAForceTurnsThem) {
    constexpr double STEPS[] = {1.0 / 30, 1.0 / 60, 1.0 / 240};
    for (int seed = 0; seed < 30; seed++) {
        Dice dice{uint64_t(seed)};
        const Twig twig = make_twig(dice);
        const frond_integrator integrator = frond_integrator(seed / 3 % FROND_INTEGRATOR_SYMPLECTIC_EULER);
        EXPECT_LT(most_stretch(twig, integrator, STEPS[seed % 3]), 3 * twig.strain + 0.02) << "seed " << seed;
    }
}

}  // namespace twigs_tests

}  // namespace frond::test
