// Corn: declarations shared by its parts.
#pragma once

#include "organs.hpp"

namespace frond::grow {

constexpr int CORN_LEAVES = 11;

// One row per phytomer, from the ground up. Lengths in metres, angles in degrees.
struct Phytomer {
    double node;    // height of the node
    double collar;  // height at which the blade leaves the stem
    double length;  // length of the blade
    double width;   // width of the blade at its widest
    double lean;    // angle of the blade's base from the vertical
    double bend;    // further angle by which the blade has turned down at its tip
    int rows;       // rows of the blade's mesh
    double dry;     // 0 green .. 1 straw
};
extern const Phytomer PHYTOMERS[CORN_LEAVES];

const Rgb SHEATH_GREEN{0.36, 0.50, 0.21}, STRAW{0.76, 0.66, 0.38};
const Rgb CORN_GREEN{0.23, 0.39, 0.15}, MIDRIB_PALE{0.57, 0.65, 0.38};
const Rgb TASSEL_STEM{0.62, 0.64, 0.32}, TASSEL_GOLD{0.80, 0.66, 0.34};
const Rgb HUSK{0.50, 0.66, 0.27}, SILK_DRY{0.48, 0.22, 0.12};

struct Corn {
    GrownPlant plant;
    Random random{0};
    double leaf_length, leaf_width, arch, height, plane;  // factors; plane: azimuth of the ranks [radian]
    double azimuths[CORN_LEAVES];
    int stem, blade, dry_blade, ear, silk, tassel, root;  // material indices

    Vec axis(double y) const;            // centre of the culm at a height
    double culm_radius(double y) const;  // radius of the culm at a height [m]
};

// Grows the blade of a phytomer from its collar.
void grow_blade(Corn& corn, int phytomer);
GrownImage corn_blade_image();

struct Ear {
    int number, phytomer;  // ear's number, and the phytomer in whose axil it stands
    double size;           // factor on the ear's size
    double turn;           // angle from the plane of the blades [radian]
    int husk_tips, strands;
};
void grow_ear(Corn& corn, const Ear& ear);

// Grows the tassel with `spikelets` on all its branches together.
void grow_tassel(Corn& corn, int spikelets);

}  // namespace frond::grow
