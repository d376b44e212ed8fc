// How a plant looks while a change of what is simulated blends out (Blend): by turns of its chain, which bend it and
// keep its lengths, and by displacements of nodes and vertices for what is left.
#pragma once

#include "plant/plant.hpp"

namespace frond {

// Points of the surface by which the chain of a cage is found, if the mechanics move the cage.
struct Marks {
    std::shared_ptr<const Follow> follow;  // how the chain would carry it
    std::vector<int> vertices;
    Carried points;
};
Marks make_marks(const Model& model, std::shared_ptr<const Follow> follow);

constexpr double SHORT = 1e-5;  // time over which rates are found [s]

// Shape and motion of a plant as it is seen, model frame.
struct Seen {
    VecX places, velocities;  // of the cage's nodes [m], [m/s]
    VecX surface;             // positions of its vertices [m]
    // Positions and rotations of the chain, and those SHORT later: rotation vectors of two mechanics do not subtract.
    VecX chain, chain_moving;
};
Seen seen_of(const Plant& plant);
VecX chain_rate(const Seen& seen);  // rate of the chain's positions and rotations
// Blends from that to what is simulated now.
void blend_from(Plant& plant, const Seen& seen);
void end_blend(Plant& plant);
inline bool blends(const Plant& plant) {
    return bool(plant.state.blend);
}
void pass_blend_time(Plant& plant, double h);

// What a plant's surface is drawn by, where the mechanics' nodes are at x, after a time.
struct Look {
    VecX chain;  // positions and rotations as seen; empty: the cage alone carries the surface
    VecX cage;   // its nodes as simulated; empty: the chain carries the surface
    VecX own;    // the chain as it fits them; what it carries is replaced by what `chain` does. Empty: nothing is
    VecX left;   // displacements of the vertices, which come on top [m]; empty: none
};
Look look_of(const Plant& plant, const VecX& x, double after);
// Returns where that has a vertex, model frame [m].
Vec3 vertex_in(const Plant& plant, const Look& look, size_t vertex);

}  // namespace frond
