// Fragment: what has come off a plant, from a capsule of the chain that broke to the tips beyond it. It moves as a
// rigid body does, which whoever simulates bodies does for it.
#pragma once

#include <memory>

#include "core/types.hpp"

namespace frond {

struct Plant;

struct Fragment {
    int node;                   // of the chain, at the end of the capsule that broke
    VecX cage_x;                // all cage nodes as they were then, model frame [m]
    std::vector<Vec3> chain_x;  // all chain nodes
    // As a rigid body, world frame. At first momentum and angular momentum are those of its nodes.
    double mass = 0;               // [kg]
    Mat3 axes = Mat3::Identity();  // principal ones, when it came off
    Vec3 moments = Vec3::Ones();   // of inertia about them [kg m^2]
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();  // now [m], [m/s], [rad/s]
    // Where it is now: what was at p in the model's frame is at turn p + shift in the world.
    Mat3 turn;
    Vec3 shift;
    Vec3 place(const Vec3& p) const { return turn * p + shift; }
    Vec3 velocity_at(const Vec3& place) const { return velocity + angular_velocity.cross(place - centre); }
};

// Which fragment a thing belongs to, -1: to the plant. All empty as long as nothing is broken.
struct Parting {
    std::vector<int> of_chain;        // one a chain node: the capsule that ends there
    std::vector<int> of_tet;          // one a tet of the cage
    std::vector<int> of_node;         // one a cage node: all its tets are gone
    std::vector<int> of_vertex;       // one a vertex of the surface
    std::vector<Triangle> triangles;  // the surface's; those across a break have no area
    VecX start;                       // of a chain: the motion's places when nodes were last taken away
};

// That of all plants of which nothing came off.
std::shared_ptr<Parting> no_parting();

// Effect: the chain node at the end of the capsule that is strained beyond its strength, if any; else -1.
int find_break(const Plant& plant);
// Takes off what is beyond a capsule, by the chain node at its end, which is not gone yet. Returns the new fragment.
const Fragment& break_off(Plant& plant, int node);
// Takes what is gone away again after the mechanics changed.
void leave_fragments(Plant& plant);
// Chain nodes that are gone go along with the stump, so that cage nodes on both sides keep their places against it.
void carry_stumps(Plant& plant);

// Fragment of a vertex, a capsule or a cage node; null: the plant's own.
const Fragment* fragment_of_vertex(const Plant& plant, size_t vertex);
const Fragment* fragment_of_chain_node(const Plant& plant, size_t node);
const Fragment* fragment_of_node(const Plant& plant, size_t node);

}  // namespace frond
