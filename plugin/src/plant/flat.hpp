// Flat: a piece of a blade as the flat thing that it is, beside the capsule that stands for it in the chain.
#pragma once

#include <array>
#include <memory>

#include "core/types.hpp"

namespace frond {

struct Model;
struct Plant;
struct Attachment;

// A direction of the modelled shape as the sum of the corners of the tets that hold a capsule's two nodes, each times
// its own number: these follow the tets [1/m].
using TetSpread = std::array<std::array<double, 4>, 2>;
TetSpread spread_of(const Model& model, int node, const Vec3& direction);

// Where the wide side of the capsule that ends at a chain node lies now, model frame; of no certain length. `modelled`
// and its spread are of the modelled shape.
Vec3 wide_now(const Plant& plant, int node, const Vec3& modelled, const TetSpread& spread);
// Columns axis, thin and wide of the capsule that ends at a chain node, as it lies now, model frame; `wide` and its
// spread are of the modelled shape. False where the capsule has lost its shape.
bool piece_frame(const Plant& plant, int node, const Vec3& wide, const TetSpread& spread, Mat3& frame);

struct Flat;
// The same of several capsules of Model::capsules, each with its own of `flats`; zero where one has lost its shape.
void piece_frames(const Plant& plant, const std::vector<int>& capsules, const std::vector<Flat>& flats,
                  std::vector<Mat3>& frames);

// Of a capsule; half_width 0 where it is not flat. Sizes are those of the rectangle with the section's second moments,
// so that a bowed blade is as high as it is bowed.
struct Flat {
    double half_width = 0, half_thickness = 0;  // [m]
    Vec3 wide = Vec3::Zero();                   // in the modelled shape, length one
    TetSpread spread = {};
};

// One a capsule. Blades whose capsules were given a radius of the caller's are as round as he wants them.
std::vector<Flat> make_flats(const Model& model);

// A point of the capsule's axis at `along` of its way, 0..1, and `across` [m] from there to its wide side: the blade's
// own half width is a lever, beside which a push turns it.
Attachment flat_attachment(const Plant& plant, int capsule, const Flat& flat, double along, double across);

}  // namespace frond
