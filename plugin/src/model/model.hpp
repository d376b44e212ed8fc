// Model: everything about a plant that does not change. Built once (modelling/build.hpp), read-only, shared by all its
// plants.
#pragma once

#include <memory>
#include <mutex>
#include "cage/cage.hpp"
#include "section/section.hpp"

namespace frond {

// The chain as arrays, for callers of the C API.
struct ChainArrays {
    std::vector<double> positions, radii;  // node_count*3 and node_count [m]
    std::vector<int32_t> parents;          // node_count
};

// Gravity under which a plant stands in its modelled shape, along the model's -y [m/s^2].
constexpr double GRAVITY = 9.81;

// Order of the displacements within a tet: 1 linear, 2 quadratic.
constexpr int HIGHEST_ORDER = 2;

// Data of each mechanics, in elements of each order, by which a plant stands as modelled and has the same natural
// frequencies in all: found for linear tets and the default mechanics at load, for the others when first requested.
// Indexed by order less one and mechanics; mechanics that move the chain have no order and use the first.
struct RestShapes {
    template <class T>
    using Each = std::array<std::array<T, FROND_MECHANICS_COUNT>, HIGHEST_ORDER>;
    std::mutex mutex;
    Each<bool> known = {};
    Each<VecX> positions;                 // rest positions of nodes, node_count*3 [m]; empty: as modelled
    Each<std::vector<double>> stiffer;    // factor on Model::young_of(), one per tet [-]; empty: one
    std::vector<double> quadratic_young;  // like Model::tet_young, for order 2 [Pa]; empty: tet_young holds for both
    std::vector<double> quadratic_grain;  // and like tet_grain
    std::vector<double> springs;  // factor on the material's stiffness for spring_chain, one per organ [-]; empty: one
};

struct Model {
    Surface surface;
    Topology topology;
    std::vector<Organ> organs;
    Chain chain;
    ChainArrays chain_view;
    std::vector<Section> sections;  // section of the capsule between a chain node and its parent, one per chain node
    bool exact_sections = false;    // sections are given, not measured on the surface
    StemSource stem_source;
    std::vector<double> chain_mass;     // part of the plant's mass at each chain node [kg]
    std::vector<double> organ_mass;     // part of it that each organ is [kg]
    std::vector<double> organ_stiffer;  // factor by which each organ is stiffer than its material so that it stands [-]
    bool calibrated = false;            // tet_young is fitted, for order 1 only; else it is the material's
    bool stands_as_modelled = false;    // under GRAVITY; else the modelled shape is the rest shape
    std::vector<std::array<int, 2>> capsules;  // chain nodes at the two ends; a root alone is both ends
    std::vector<int> organ_parents;            // organ that each organ grows out of; -1: the ground, or nothing
    Cage cage;
    bool has_own_tets = false;        // the cage are the caller's own tets, the plant's true shape
    Embedding embedding;              // surface vertices in the cage
    Embedding chain_embedding;        // chain nodes in the cage
    std::vector<double> tet_density;  // densities of the cage's tets, so that each organ has its proper mass [kg/m^3]
    std::vector<double> tet_young;    // Young's moduli of the cage's tets, calibrated or the material's [Pa]
    std::vector<double> tet_poisson;
    // Fibres along the organ that a calibrated cage has beside its tissue (mechanics/grain.hpp): modulus over the
    // tissue's shear modulus [-], direction of length one.
    std::vector<double> tet_grain;
    std::vector<Vec3> tet_axis;
    std::vector<uint8_t> root;  // cage nodes that the ground holds unless a plant sets them otherwise, node_count
    std::shared_ptr<RestShapes> rest_shapes = std::make_shared<RestShapes>();
    double stiffening_factor = 1;  // factor by which the organs were stiffened so that the plant stands [-]
    CageReport cage_report;
    double ms_import = 0, ms_cage = 0, ms_chain = 0, ms_total = 0;

    double mass() const;                                   // [kg]
    const std::vector<double>& young_of(int order) const;  // moduli of the tets, as elements of an order [Pa]
    const std::vector<double>& grain_of(int order) const;  // and their fibres'
};

}  // namespace frond
