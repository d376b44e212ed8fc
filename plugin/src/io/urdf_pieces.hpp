// URDF pieces: the shapes of a tree of links that a plant is made of.
#pragma once

#include "io/urdf.hpp"
#include "skeleton/chain.hpp"
#include "surface/surface.hpp"

namespace frond {

// A shape in the plant's frame, with all joints at zero.
struct UrdfPiece {
    int link;
    const UrdfShape* shape;  // in the tree
    UrdfFrame frame;         // frame of the shape, in the plant's own frame
};
// Lists each link's visual shapes or, if it has none, its collision shapes. `turn` takes the root's frame to the
// plant's. Throws BAD_GEOMETRY if there are none at all.
std::vector<UrdfPiece> list_pieces(const UrdfTree& tree, const Quat& turn);
// Returns for each link the nearest link towards the root that has a shape; -1 if there is none.
std::vector<int> shown_parents(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// Returns whether all shapes are cylinders and capsules, so that their sections are known; stems_of() returns those as
// stems, one per shape.
bool are_stems(const std::vector<UrdfPiece>& pieces);
std::vector<frond_stem> stems_of(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// Makes a surface of one part per link, with the link's name.
Surface surface_of_pieces(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// Names organs after links; link_of_part[p] is the link that a part of the surface came from. Kind and material come
// from <frond organ="" material=""/> if the link has that, else from the names of the link and of its material; else
// the kind stays the same. Throws BAD_ARGUMENT, naming the link, for unknown kinds and materials.
void name_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface,
                 std::vector<Organ>& organs);
// Merges organs to which their links give the same name, in the chain and the parts too.
void merge_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface, Chain& chain,
                  std::vector<Organ>& organs);

}  // namespace frond
