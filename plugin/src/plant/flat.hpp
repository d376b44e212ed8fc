// Flat: a segment of a blade as a flat shape, beside the capsule that represents it in the chain.
#pragma once

#include <array>
#include <memory>

#include "core/types.hpp"

namespace frond {

struct Model;
struct Plant;
struct Attachment;

// A direction of the modelled shape as a weighted sum of the corners of the tets that hold a capsule's two nodes, so
// that it follows the tets: the corners' weights [1/m].
using TetSpread = std::array<std::array<double, 4>, 2>;
TetSpread spread_of(const Model& model, int node, const Vec3& direction);

// Returns the present direction of the wide side of the capsule that ends at a chain node, model frame, not normalised.
// `modelled` and `spread` give it in the modelled shape.
Vec3 wide_now(const Plant& plant, int node, const Vec3& modelled, const TetSpread& spread);
// Finds the present axis, thin and wide of the capsule that ends at a chain node, as columns, model frame; `wide` and
// `spread` are of the modelled shape. False if the capsule has collapsed.
bool piece_frame(const Plant& plant, int node, const Vec3& wide, const TetSpread& spread, Mat3& frame);

struct Flat;
// Does the same for several capsules of Model::capsules, each with its own of `flats`; zero where one has collapsed.
void piece_frames(const Plant& plant, const std::vector<int>& capsules, const std::vector<Flat>& flats,
                  std::vector<Mat3>& frames);

// Shape of a capsule; half_width is 0 if it is not flat. Sizes are those of the rectangle with the section's second
// moments, so that a bowed blade is as high as its bow.
struct Flat {
    double half_width = 0, half_thickness = 0;  // [m]
    Vec3 wide = Vec3::Zero();                   // wide direction in the modelled shape, length one
    TetSpread spread = {};
};

// Makes one per capsule. Blades whose capsules have a radius given by the caller stay round.
std::vector<Flat> make_flats(const Model& model);

// Returns the point at `along`, 0..1, of a capsule's axis and `across` [m] from there towards its wide side: a push
// beside the axis turns the blade, with this distance as lever.
Attachment flat_attachment(const Plant& plant, int capsule, const Flat& flat, double along, double across);

}  // namespace frond
