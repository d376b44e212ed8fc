// placements: counts the pairs of overlapping corn plants that are apart from 2 to 4 s, measured by FCL. Two of the
// placements are those of the scene corn_pair and of examples/pair.c, the others are random.
//     placements [COUNT [STEPS_A_SECOND [MECHANICS [AT_LEAST [COLLISION]]]]]
// Fails if fewer than AT_LEAST of them overlap by less than 1 mm.
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "support/stand.hpp"

namespace frond::test {
namespace {

constexpr double APART = 0.001;  // [m]

// Returns a random number from the generator's bits, so that all standard libraries give the same.
double between(std::mt19937& random, double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
}

// Returns plants 0.8 to 1 m apart, with random rotations, whose cages overlap by 1 cm or more.
Placement draw_placement(std::mt19937& random) {
    constexpr double NEAREST = 0.8, FARTHEST = 1, IN = 0.01;  // [m]
    for (;;) {
        const double away = between(random, NEAREST, FARTHEST), angle = between(random, 0, 2 * M_PI);
        const double first = between(random, 0, 2 * M_PI), second = between(random, 0, 2 * M_PI);
        const Placement placement = {{away * std::cos(angle), 0, away * std::sin(angle)}, {first, second}};
        if (CornPair(FROND_RESPONSE_NONE, FROND_MECHANICS_TET_COROTATIONAL, H, placement).cage_depth() > IN)
            return placement;
    }
}

struct Deepest {
    double cages = 0, surfaces = 0;  // [m]
    int late = 0;                    // steps with more overlap than allowed
};

// Returns the largest overlap of all steps from 2 to 4 s. Rods do not touch by their cages.
Deepest play(const Placement& placement, frond_mechanics mechanics, int steps_a_second, frond_collision collision) {
    CornPair pair(FROND_RESPONSE_IMPULSE, mechanics, 1.0 / steps_a_second, placement, collision);
    const bool by_cages = collision == FROND_COLLISION_CAGE && mechanics != FROND_MECHANICS_ROD &&
                          mechanics != FROND_MECHANICS_SPRING_CHAIN;
    Deepest deepest;
    pair.steps(2 * steps_a_second - 1);
    for (int i = 0; i <= 2 * steps_a_second; i++) {
        pair.steps(1);
        const double cages = by_cages ? pair.cage_depth() : 0, surfaces = pair.surface_depth();
        deepest.cages = std::max(deepest.cages, cages);
        deepest.surfaces = std::max(deepest.surfaces, surfaces);
        deepest.late += std::max(cages, surfaces) >= APART;
    }
    return deepest;
}

int run(int count, int steps_a_second, frond_mechanics mechanics, int at_least, frond_collision collision) {
    std::mt19937 random(1);
    int apart = 0;
    std::printf("%s by %s, 1/%d s; deepest from 2 to 4 s [mm]\n%-3s %7s %7s %7s %7s %9s %9s %7s\n",
                frond_mechanics_name(mechanics), frond_collision_name(collision), steps_a_second, "", "x", "z", "turn",
                "turn", "cages", "surfaces", "steps");
    for (int i = 0; i < count; i++) {
        const Placement placement = i == 0 ? AS_IN_SCENE : i == 1 ? AS_IN_EXAMPLE : draw_placement(random);
        const Deepest deepest = play(placement, mechanics, steps_a_second, collision);
        apart += deepest.late == 0;
        std::printf("%-3d %7.3f %7.3f %7.3f %7.3f %9.2f %9.2f %7d\n", i, placement.place.x, placement.place.z,
                    placement.turns[0], placement.turns[1], 1000 * deepest.cages, 1000 * deepest.surfaces,
                    deepest.late);
        std::fflush(stdout);
    }
    std::printf("%d of %d less than 1 mm in each other\n", apart, count);
    return apart < at_least;
}

}  // namespace
}  // namespace frond::test

int main(int argc, char** argv) {
    const auto number = [&](int k, int otherwise) { return argc > k ? std::atoi(argv[k]) : otherwise; };
    const std::string wanted = argc > 3 ? argv[3] : frond_mechanics_name(FROND_MECHANICS_TET_COROTATIONAL);
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++)
        if (wanted == frond_mechanics_name(frond_mechanics(which)))
            return frond::test::run(number(1, 30), std::max(1, number(2, 60)), frond_mechanics(which), number(4, 0),
                                    argc > 5 && std::string(argv[5]) == frond_collision_name(FROND_COLLISION_CAGE)
                                        ? FROND_COLLISION_CAGE
                                        : FROND_COLLISION_ORGANS);
    std::fprintf(stderr, "there are no mechanics %s\n", wanted.c_str());
    return 2;
}
