// Corrections: what a person says about a plant where Frond's guess is wrong.
#pragma once

#include "skeleton/chain.hpp"

namespace frond {

// A field of a material, as files name it.
struct MaterialField {
    const char* name;
    double Material::*field;
};
constexpr MaterialField MATERIAL_FIELDS[] = {
    {"density", &Material::density},
    {"young", &Material::young},
    {"poisson", &Material::poisson},
    {"thickness", &Material::thickness},
    {"hollow", &Material::hollow},
    {"twist_to_bend", &Material::twist_to_bend},
    {"damping_ratio", &Material::damping_ratio},
    {"friction", &Material::friction},
    {"yield_strain", &Material::yield_strain},
    {"creep_rate", &Material::creep_rate},
    {"strength", &Material::strength},
    {"drag", &Material::drag},
    {"midrib", &Material::midrib},
    {"restitution", &Material::restitution},
};

struct OrganCorrection {
    std::string organ;                                  // its name as it is found without corrections
    std::string kind, parent;                           // empty: as found
    std::vector<std::pair<int, double>> material = {};  // by MATERIAL_FIELDS
    bool is_root = false, leave_out = false;
};

// What a file MESH.frond.json says.
struct Corrections {
    double unit = 0;              // metres per unit of the mesh file; 0: not said
    Vec3 up = Vec3::Zero();       // of the mesh file; zero: not said
    double allow_stiffening = 0;  // see frond_model_def; 0: not said
    std::vector<OrganCorrection> organs = {};
};

// Corrects organs that were found: kinds, with their presets, and materials; leaves organs out of the surface; hangs
// organs that are meshes of their own on other parents, by moving the joints of the topology. Later corrections of an
// organ win. Fails with BAD_ARGUMENT, naming the organs or kinds there are.
// Returns the organs that the plant stands on; empty: those that it is found to stand on.
std::vector<int> correct_organs(const std::vector<OrganCorrection>& corrections, Surface& surface, Topology& topology,
                                std::vector<Organ>& organs);

// Replaces materials by the caller's, by the organs' names or kinds; the last match wins. These come whole, so a number
// counts as given where it is not the one that the organ had. Fails with BAD_ARGUMENT where one matches no organ,
// naming those there are.
void override_materials(std::vector<Organ>& organs, const frond_organ_material* overrides, int count);

// Returns the organ that each organ grows out of, -1: the ground, or nothing.
std::vector<int> find_parents(const Chain& chain, size_t organ_count);

}  // namespace frond
