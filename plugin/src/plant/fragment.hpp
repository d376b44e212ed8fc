// Fragment: a part that has come off a plant, from a capsule of the chain that broke to the tips beyond it. It moves as
// a rigid body, simulated by whoever simulates bodies.
#pragma once

#include <memory>

#include "core/types.hpp"

namespace frond {

struct Follow;
struct Plant;
struct System;

// Present motion of its rigid body, and its present place: a point p of the model's frame is at turn p + shift in the
// world.
struct FragmentMotion {
    Mat3 turn;
    Vec3 shift;
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();  // [m], [m/s], [rad/s]
};
struct Fragment : FragmentMotion {
    int node;  // chain node at the end of the capsule that broke
    // Its shape, sprung back from that at the break.
    VecX cage_x;  // all cage nodes, model frame [m]
    // With a chain: positions and rotations of all its nodes, and what follows them; else empty and null.
    VecX x;
    std::shared_ptr<const Follow> follow;
    std::vector<Vec3> chain_x;  // all chain nodes, model frame [m]
    // Rigid body, world frame. Its first momentum and angular momentum are those of its nodes.
    double mass = 0;               // [kg]
    Mat3 axes = Mat3::Identity();  // principal axes when it came off
    Vec3 moments = Vec3::Ones();   // principal moments of inertia [kg m^2]
    Vec3 place(const Vec3& p) const { return turn * p + shift; }
    Vec3 velocity_at(const Vec3& place) const { return velocity + angular_velocity.cross(place - centre); }
};

// Fragment that each part belongs to; -1: the plant. All lists are empty as long as nothing is broken.
struct Parting {
    std::vector<int> of_chain;        // one per chain node: the capsule that ends there
    std::vector<int> of_tet;          // one per tet of the cage
    std::vector<int> of_node;         // one per cage node; -1 while any of its tets is left
    std::vector<int> of_vertex;       // one per vertex of the surface
    std::vector<Triangle> triangles;  // the surface's; those across a break have no area
    VecX start;                       // with a chain: Motion::x when nodes were last taken away
};

// Returns the one of all plants that have no fragments.
std::shared_ptr<Parting> no_parting();

// Effect: returns the chain node at the end of a capsule that is strained beyond its strength; -1 if there is none.
int find_break(const Plant& plant);
// Takes off the part beyond a capsule, given by the chain node at its end, which is not gone yet. Returns the new
// fragment.
const Fragment& break_off(Plant& plant, int node);
// Returns a system of the plant's model, in whatever mechanics, without the elements of its first `count` fragments.
std::shared_ptr<const System> without_fragments(const Plant& plant, const System& system, size_t count);
// Takes all fragments away again after the mechanics changed.
void leave_fragments(Plant& plant);
// Has all fragments but the first `count` be the plant's again. Its motion and what yielded are those of a new plant.
void rejoin(Plant& plant, size_t count);
// Moves chain nodes that are gone with the stump, so that cage nodes on both sides keep their places against it.
void carry_stumps(Plant& plant);

// Return the fragment of a vertex, a chain node or a cage node; null: the plant's own.
const Fragment* fragment_of_vertex(const Plant& plant, size_t vertex);
const Fragment* fragment_of_chain_node(const Plant& plant, size_t node);
const Fragment* fragment_of_node(const Plant& plant, size_t node);

}  // namespace frond
