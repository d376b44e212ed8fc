// Cucumber: what its parts share.
#pragma once

#include "organs.hpp"

namespace frond::grow {

const Rgb CUCUMBER_VEIN{0.58, 0.72, 0.36};

struct CucumberBlade {
    Vec center;   // where the petiole ends
    Vec forward;  // towards the tip
    Vec normal;   // of the upper side
    double size;  // from the petiole to the tip [m]
    double droop;
    Rgb color, margin;  // times the texture
};
GrownImage cucumber_blade_image();
// 1 on a side vein, 0 away from it; `sharp` (below 0.5) tells how thin it is. Lengths as shares of the leaf's.
double cucumber_side_vein(double along, double off, double sharp);
void add_cucumber_blade(GrownPlant& plant, const CucumberBlade& blade, Random random);

struct CucumberFruit {
    Vec top;        // where it hangs on its stalk
    Vec down;       // direction at the top
    double length;  // [m]
    double radius;  // [m]
    double ripe;    // 0 just set .. 1 ready for picking
    int rings, sides;
};
TubeMesh add_cucumber_fruit(GrownPlant& plant, const CucumberFruit& fruit, Random random);

// Five petals and a throat about an axis.
void add_cucumber_flower(GrownPlant& plant, Vec center, Vec axis, double size, Random random);

// The stake that the stem climbs. Lengths in metres.
struct CucumberStake {
    Vec foot;                  // where it comes out of the ground
    double top;                // its height
    std::vector<double> ties;  // heights at which stem and stake touch
    int material, tie_material;
};
double cucumber_stake_radius(double y);
// Adds the organs "stake" and "tie_1", "tie_2" ...; the stem must have been added as a tube.
void add_cucumber_stake(GrownPlant& plant, const CucumberStake& stake, const TubeMesh& stem,
                        const std::function<double(double)>& stem_radius);

}  // namespace frond::grow
