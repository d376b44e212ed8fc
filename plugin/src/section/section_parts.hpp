// Declarations that the sources of Section share: two measurements of the surface around a capsule.
#pragma once

#include "section/section.hpp"

namespace frond {

// The axis of a capsule and two directions across it.
struct CapsuleFrame {
    Vec3 begin, axis, across, other;
    double length;  // [m]
};

// Spread of the surface across the axis, the small one first, with the direction of the small one.
struct Spread {
    double area;          // area of the surface [m^2]
    double small, large;  // variances [m^2]
    Vec3 thin;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // mean offset from the axis [m]
};

// The cuts of planes across a capsule with the surface, as those in its middle that together with the taper stand for
// all of them.
struct Outline {
    bool found = false;                 // planes cut closed outlines, or both faces of a sheet
    double area;                        // enclosed area, of all outlines [m^2]
    double inertia_thin, inertia_wide;  // each outline's about its own middle, added up [m^4]
    double taper;                       // see Section
    Vec3 thin;
    // For sheets: whether they are drawn with two faces, and their distance, by the rectangle of equal
    // area and perimeter [m].
    bool doubled = false;
    double gap = 0;
};

// The cut of the ribs of a sheet, across and other as coordinates.
struct RibCut {
    double area = 0;                                    // [m^2]; 0: there is none
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();   // [m]
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();  // second moments about the middle [m^4]
    int organ = -1;
};

// Return one result per chain node. A capsule without surface of its own has a spread of zero area.
std::vector<Spread> measure_spreads(const Surface& surface, const Chain& chain, const std::vector<CapsuleFrame>& frames,
                                    const std::vector<char>& hearts);
std::vector<Outline> cut_outlines(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
                                  const Chain& chain, const std::vector<CapsuleFrame>& frames);

// Returns the ribs of each capsule, by Chain::rib_of.
std::vector<RibCut> cut_ribs(const Surface& surface, const Topology& topology, const Chain& chain,
                             const std::vector<CapsuleFrame>& frames);

// Returns 0 for an ellipse and a polygon like one, 1 for a rectangle.
double squareness(double area, double inertia_thin, double inertia_wide);

// Returns which capsules are the heart of a rosette: they begin at a root, and leaves of several organs begin at their
// end. All that is drawn there carries these.
std::vector<char> find_hearts(const Chain& chain);

// Add to finished sections what a mesh does not show: the wood that carries a crown goes on in it, and soil holds a
// swollen root where it thins below.
void carry_crowns(const Chain& chain, const std::vector<Organ>& organs, std::vector<Section>& sections);
void hold_roots(const Chain& chain, const std::vector<Organ>& organs, std::vector<Section>& sections);

// Lists the chain nodes on the ways between those that a triangle's corners are assigned to, without these: a long
// triangle of a coarse mesh passes capsules at which it has no corner.
void list_nodes_between(const Chain& chain, const Triangle& triangle, std::vector<int>& nodes);

}  // namespace frond
