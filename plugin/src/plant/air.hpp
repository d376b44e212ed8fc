// Air: what the air around a plant does to it. Each capsule of the chain is a piece of its organ that resists the air
// which passes it.
#pragma once

#include "plant/flat.hpp"
#include "plant/wind.hpp"
#include "solve/solve.hpp"

namespace frond {

enum class AirShape {
    SHEET,   // pressed along its normal
    ROUND,   // pushed across its axis
    COMPACT  // pushed the way the air goes
};

// Of the capsule between a chain node and its parent.
struct AirPiece {
    int node, parent;
    AirShape shape;
    double coefficient;  // of drag [-]; 0: by Reynolds number
    Vec3 area;           // that is seen along axis, thin and wide [m^2]
    double size;         // of Reynolds number: the piece's width [m]
    double skin;         // its surface [m^2]
    double chord_along;  // how far air goes along the skin, along the axis and across it [m]
    double chord_across;
    Vec3 wide;         // in the modelled shape, length one
    TetSpread spread;  // of `wide`
};
using AirPieces = std::vector<AirPiece>;

// Shared by all plants of a model; those of one shape follow each other.
AirPieces make_air_pieces(const Model& model);

// The force of air that passes the piece with `velocity` is this times the velocity [N s/m]; symmetric, never negative.
// `frame` has the columns axis, thin, wide. It holds for the speed given.
Mat3 air_resistance(const AirPiece& piece, const Mat3& frame, const Vec3& velocity, double density);

// A symmetric matrix: xx, xy, xz, yy, yz, zz.
using SixOf = std::array<double, 6>;
inline Mat3 matrix_of(const SixOf& s) {
    return (Mat3() << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]).finished();
}

// What a plant in air needs; plants without have none.
struct AirState {
    std::shared_ptr<const AirPieces> pieces;
    std::vector<frond_vec3> points, wind;   // one a chain node, world frame [m], [m/s]
    std::vector<Vec3> velocities, passing;  // of chain nodes, and of the air past them, model frame [m/s]
    std::vector<Vec3> wide;                 // one a piece, where its wide side lies now, of no certain length
    std::vector<SixOf> resistance, lag;     // one a chain node [N s/m]
};

}  // namespace frond
