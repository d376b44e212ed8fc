// Cucumber: declarations shared by its parts.
#pragma once

#include "organs.hpp"

namespace frond::grow {

const Rgb CUCUMBER_VEIN{0.58, 0.72, 0.36};

struct CucumberBlade {
    Vec center;   // end of the petiole
    Vec forward;  // direction towards the tip
    Vec normal;   // normal of the upper side
    double size;  // length from the petiole to the tip [m]
    double droop;
    Rgb color, margin;  // multiplied with the texture
};
GrownImage cucumber_blade_image();
// Returns 1 on a side vein, 0 away from it; the larger `sharp` (below 0.5), the thinner the vein. Lengths are shares of
// the leaf's.
double cucumber_side_vein(double along, double off, double sharp);
void add_cucumber_blade(GrownPlant& plant, const CucumberBlade& blade, Random random);

struct CucumberFruit {
    Vec top;        // point at which the fruit hangs on its stalk
    Vec down;       // direction at the top
    double length;  // [m]
    double radius;  // [m]
    double ripe;    // 0: just set .. 1: ready for picking
    int rings, sides;
};
TubeMesh add_cucumber_fruit(GrownPlant& plant, const CucumberFruit& fruit, Random random);

// Adds five petals and a throat about an axis.
void add_cucumber_flower(GrownPlant& plant, Vec center, Vec axis, double size, Random random);

// The stake that the stem climbs. Lengths in metres.
struct CucumberStake {
    Vec foot;                  // point where the stake leaves the ground
    double top;                // height of its top
    std::vector<double> ties;  // heights at which stem and stake touch
    int material, tie_material;
};
double cucumber_stake_radius(double y);
// Adds the organs "stake" and "tie_1", "tie_2" ...; the stem must have been added as a tube.
void add_cucumber_stake(GrownPlant& plant, const CucumberStake& stake, const TubeMesh& stem,
                        const std::function<double(double)>& stem_radius);

}  // namespace frond::grow
