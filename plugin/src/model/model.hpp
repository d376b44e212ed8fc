// Model: everything about a plant that does not change. Built once, read-only, shared by all its plants.
#pragma once

#include <memory>
#include <mutex>
#include "model/cage.hpp"

#include "model/section.hpp"

namespace frond {

// The chain in arrays, for those who read it through the C API.
struct ChainArrays {
    std::vector<double> positions, radii;  // node_count*3 and node_count [m]
    std::vector<int32_t> parents;          // node_count
};

// Under which a plant stands as it was modelled, along the model's -y [m/s^2].
constexpr double GRAVITY = 9.81;

// Order of the displacements within a tet: 1 linear, 2 quadratic.
constexpr int HIGHEST_ORDER = 2;

// The data that each mechanics, in elements of each order, has of its own so that a plant stands as modelled and sways
// alike in all: found for linear tets and the default mechanics at load, for the others when first asked for. By order
// less one and mechanics; what moves the chain has no order and stands with the first.
struct RestShapes {
    template <class T>
    using Each = std::array<std::array<T, FROND_MECHANICS_COUNT>, HIGHEST_ORDER>;
    std::mutex mutex;
    Each<bool> known = {};
    Each<VecX> positions;                 // nodes without gravity, node_count*3 [m]; empty: as modelled
    Each<std::vector<double>> stiffer;    // than Model::young_of(), one a tet [-]; empty: not
    std::vector<double> quadratic_young;  // like Model::tet_young, for order 2; empty: those hold for both [Pa]
    std::vector<double> springs;          // than their material, spring_chain's capsules of each organ [-]; empty: not
};

struct Model {
    Surface surface;
    Topology topology;
    std::vector<Organ> organs;
    Chain chain;
    ChainArrays chain_view;
    std::vector<Section> sections;      // of the capsule between a chain node and its parent, one a chain node
    bool exact_sections = false;        // they are given, not measured on the surface
    std::vector<double> chain_mass;     // that each chain node carries of the plant's mass [kg]
    std::vector<double> organ_stiffer;  // how much stiffer than its material each organ was made so that it stands [-]
    bool calibrated = false;            // tet_young is fitted, for order 1 only; else it is the material's
    bool stands_as_modelled = false;    // under GRAVITY; else the modelled shape is the one without it
    std::vector<std::array<int, 2>> capsules;  // chain nodes at the two ends; a root alone is both ends
    Cage cage;
    Embedding embedding;              // surface vertices in the cage
    Embedding chain_embedding;        // chain nodes in the cage
    std::vector<double> tet_density;  // of the cage's tets, so that the organ weighs what it should [kg/m^3]
    std::vector<double> tet_young;    // so that it bends as it should [Pa]
    std::vector<double> tet_poisson;
    std::vector<uint8_t> root;  // cage nodes that the ground holds unless a plant says otherwise, node_count
    std::shared_ptr<RestShapes> rest_shapes = std::make_shared<RestShapes>();
    double stiffening_factor = 1;  // how much stiffer the organs were made so that the plant stands [-]
    CageReport cage_report;
    double ms_import = 0, ms_cage = 0, ms_chain = 0, ms_total = 0;

    double mass() const;                                   // [kg]
    const std::vector<double>& young_of(int order) const;  // of the tets, as elements of an order [Pa]
};

// The cage nodes of the tets that hold the foot of the chain's roots: a drooping leaf that touches the ground stays
// free.
std::vector<uint8_t> find_root_nodes(const Model& model);
// Fills capsules, chain_view and chain_embedding of a model whose surface, chain and cage stand.
void bind_chain(Model& model);

}  // namespace frond
