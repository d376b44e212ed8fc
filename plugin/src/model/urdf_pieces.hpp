// Urdf pieces: what of a tree of links a plant is made of.
#pragma once

#include "model/chain.hpp"
#include "model/surface.hpp"
#include "model/urdf.hpp"

namespace frond {

// A shape that is seen, with all joints at zero.
struct UrdfPiece {
    int link;
    const UrdfShape* shape;  // the tree's
    UrdfFrame frame;         // of the shape, in the plant's own frame
};
// Of each link what it shows or, if that is nothing, what collides. `turn` takes the root's frame to the plant's.
// Throws BAD_GEOMETRY if there is nothing.
std::vector<UrdfPiece> list_pieces(const UrdfTree& tree, const Quat& turn);
// The nearest link on the way to the root that has a piece; -1 if there is none.
std::vector<int> shown_parents(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// Tells whether all pieces are cylinders and capsules, so that their sections are known; and those as stems, one a
// piece.
bool are_stems(const std::vector<UrdfPiece>& pieces);
std::vector<frond_stem> stems_of(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// One part a link, called as the link is. `turn` as above.
Surface surface_of_pieces(const UrdfTree& tree, const std::vector<UrdfPiece>& pieces);

// Names organs after links: link_of_part[p] is the link that a part of the surface came from. Kind and material are
// those of <frond organ="" material=""/> where the link has that, else what is said by the names of the link and of its
// material, else what they were. Throws BAD_ARGUMENT, naming the link, for kinds and materials that there are not.
void name_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface,
                 std::vector<Organ>& organs);
// Makes those organs one to which their links give the same name; in the chain and the parts too.
void merge_organs(const UrdfTree& tree, const std::vector<int>& link_of_part, Surface& surface, Chain& chain,
                  std::vector<Organ>& organs);

}  // namespace frond
