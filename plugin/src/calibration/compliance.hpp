// Compliance of an organ held at its base: the displacement by each of several unit loads at the point of each other
// load, along that one. By linear theory, for the organ's rods and for its cage. Forces and moments at the tip
// determine its displacement and rotation; a force half-way and weight determine how the organ bends in between.
#pragma once

#include "calibration/lone_organ.hpp"
#include "calibration/static_stiffness.hpp"
#include "calibration/tet_products.hpp"

namespace frond {

// Loads along and about the axes of the tip's frame in turn: force [N] and moment [N m] at the tip, force at the middle
// [N], weight of the organ and of what it bears under one m/s^2.
enum LoadKind { TIP_FORCE = 0, TIP_MOMENT = 3, MIDDLE_FORCE = 6, WEIGHT = 9, LOAD_COUNT = 12 };
using Compliance = Products<LOAD_COUNT>;

// Points at which an organ is loaded.
struct LoadPlaces {
    int tip = -1;  // chain node that is farthest along the chain; -1: the organ has no segments
    int middle;    // node on the path to the tip that is nearest to the mean distance of the mass that the organ bears
    Mat3 frame;    // frame of the last section: thin, wide and axis
};
LoadPlaces find_load_places(const Model& plant, int organ);

// Returns each segment's share in the compliance of an organ's rods, by chain nodes; zero for other organs.
std::vector<Compliance> rod_compliances(const Model& plant, int organ, const LoadPlaces& places);

// Returns the loads of an organ's cage, one per column: forces and moments distributed over the nodes around their
// point as by a rigid body.
using CageLoads = Eigen::Matrix<double, Eigen::Dynamic, LOAD_COUNT>;
CageLoads cage_loads(const LoneOrgan& lone, const TetElements& elements, const Model& plant,
                     const std::vector<int>& hangs, const LoadPlaces& places);
// Returns the shares in the compliance of an organ's cage of each tet's tissue, then of each tet's fibres; empty if its
// root does not hold it.
std::vector<Compliance> cage_compliances(const LoneOrgan& lone, const TetElements& elements, StaticStiffness& stiffness,
                                         const CageLoads& loads);

// Returns the mean length of the edges of a cage's tets [m].
double mean_edge(const Cage& cage);

Compliance sum_of(const std::vector<Compliance>& shares);

}  // namespace frond
