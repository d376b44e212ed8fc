// Compliance of an organ that is held at its base: how far each of several unit loads moves the place of each other
// one, along it. By linear theory, of the organ's rods and of its cage. Forces and moments at the tip tell where it
// comes to lie and how it turns; a force half-way and weight tell how the way there bends.
#pragma once

#include "build/lone_organ.hpp"
#include "build/static_stiffness.hpp"
#include "build/tet_products.hpp"

namespace frond {

// Along and about the axes of the tip's frame in turn: force [N] and moment [N m] at the tip, force at the middle [N],
// weight of the organ and of what it bears under one m/s^2.
enum LoadKind { TIP_FORCE = 0, TIP_MOMENT = 3, MIDDLE_FORCE = 6, WEIGHT = 9, LOAD_COUNT = 12 };
using Compliance = Products<LOAD_COUNT>;

// Where an organ is loaded.
struct LoadPlaces {
    int tip = -1;  // chain node, the farthest one along the chain; -1: the organ has no pieces
    int middle;    // the one on the way to it that is nearest to the mean distance of the mass that the organ bears
    Mat3 frame;    // of the last section: thin, wide and axis
};
LoadPlaces find_load_places(const Model& plant, int organ);

// Each piece's share in the compliance of an organ's rods, by chain nodes; zero for those of other organs.
std::vector<Compliance> rod_compliances(const Model& plant, int organ, const LoadPlaces& places);

// Loads of an organ's cage, one a column: forces and moments on the nodes around their place, shared out as a rigid
// body would.
using CageLoads = Eigen::Matrix<double, Eigen::Dynamic, LOAD_COUNT>;
CageLoads cage_loads(const LoneOrgan& lone, const TetElements& elements, const Model& plant,
                     const std::vector<int>& hangs, const LoadPlaces& places);
// Each tet's share in the compliance of an organ's cage; empty if its root does not hold it.
std::vector<Compliance> cage_compliances(const LoneOrgan& lone, const TetElements& elements, StaticStiffness& stiffness,
                                         const CageLoads& loads);

// Returns the mean length of the edges of a cage's tets [m].
double mean_edge(const Cage& cage);

Compliance sum_of(const std::vector<Compliance>& shares);

}  // namespace frond
