// Skin: how the surface is attached to the chain, for mechanics that move the chain. Shared by all plants of a model.
//
// A vertex follows the capsule that its part of the surface belongs to. At s, its share of the way along that, it is
// carried by a cubic (Hermite) centre line through both nodes, along their axes, and by both nodes' rotations, blended
// smoothly. At s = 0 and 1 it is rigid with one node, and so is what the surface continues with: it cannot tear.
#pragma once

#include "mechanics/attachment.hpp"
#include "model/model.hpp"

namespace frond {

struct SkinVertex {
    int node;        // chain node at the end of its capsule
    double along;    // s [-]
    Vec3 across;     // from the capsule's axis at s to the vertex, in the modelled shape [m]
    Vec3f gradient;  // of s on the surface [1/m]
};

struct Skin {
    std::vector<SkinVertex> vertices;
    std::vector<int> by_capsule;  // vertices in the order of their chain nodes
    std::vector<int> parents;     // begin of the capsule that ends at a chain node; the node itself at a root
    std::vector<Vec3> axes;       // from there to the node, in the modelled shape [m]
};

Skin make_skin(const Model& model);
// Returns the attachment of a vertex, for forces on it.
Attachment skin_attachment(const Skin& skin, const SkinVertex& vertex);

// A drawing of some of the vertices.
struct SkinDrawing {
    const VecX& x;  // positions and rotations of the chain's nodes, model frame [m]
    Mat3 turn;      // from the model's frame to the world's
    Vec3 shift;
    const std::vector<int>& part_of_vertex;  // empty: all vertices are drawn
    int part;                                // the part that is drawn
    const std::vector<Vec3f>& modelled_normals;
    float* positions;  // world frame [m], 3 per vertex
    float* normals;    // null: not wanted
};
void draw_skin(const Skin& skin, const SkinDrawing& drawing);

}  // namespace frond
