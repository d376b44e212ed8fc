// Air: the force of the surrounding air on a plant. Each capsule of the chain is a segment of its organ that resists
// the air flowing past it.
#pragma once

#include "plant/flat.hpp"
#include "plant/wind.hpp"
#include "solve/solve.hpp"

namespace frond {

enum class AirShape {
    SHEET,   // pressure along its normal
    ROUND,   // pressure across its axis
    COMPACT  // pressure along the flow
};

// Aerodynamic data of the capsule between a chain node and its parent.
struct AirPiece {
    int node, parent;
    AirShape shape;
    double coefficient;  // drag coefficient [-]; 0: by Reynolds number
    Vec3 area;           // areas seen along axis, thin and wide [m^2]
    double size;         // length for the Reynolds number: the segment's width [m]
    double skin;         // surface area [m^2]
    double chord_along;  // lengths over which air flows along the skin, along the axis and across it [m]
    double chord_across;
    Vec3 wide;         // direction of the wide side in the modelled shape, length one
    TetSpread spread;  // corner weights of `wide`
};
using AirPieces = std::vector<AirPiece>;

// Makes the segments, shared by all plants of a model; those of one shape follow each other.
AirPieces make_air_pieces(const Model& model);

// Returns the resistance [N s/m], symmetric and never negative, at the given speed: times the velocity of the air past
// the segment it is the air's force. `frame` has the columns axis, thin, wide.
Mat3 air_resistance(const AirPiece& piece, const Mat3& frame, const Vec3& velocity, double density);

// A symmetric matrix: xx, xy, xz, yy, yz, zz.
using SixOf = std::array<double, 6>;
inline Mat3 matrix_of(const SixOf& s) {
    return (Mat3() << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]).finished();
}

// State of a plant in air; a plant without air has none.
struct AirState {
    std::shared_ptr<const AirPieces> pieces;
    std::vector<frond_vec3> points, wind;   // positions and wind, one per chain node, world frame [m], [m/s]
    std::vector<Vec3> velocities, passing;  // of chain nodes, and of the air relative to them, model frame [m/s]
    std::vector<Vec3> wide;                 // present direction of each segment's wide side, not normalised
    std::vector<SixOf> resistance, lag;     // one per chain node [N s/m]
};

}  // namespace frond
