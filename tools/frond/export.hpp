// Export: files for other programs of the plants on a stage.
#pragma once

#include <fstream>

#include "scenes/scene.hpp"

namespace frond::tools {

// Both throw a SceneError that names the file.
std::ofstream open_to_write(const std::string& path, bool binary = false);
void close(std::ofstream& file, const std::string& path);

// Surfaces of all plants at one time.
struct Sample {
    double time;                                      // time of the sample [s]
    std::vector<std::vector<float>> places, normals;  // vertex positions [m] and normals of each plant
};
Sample sample_of(const Stage& stage);

// Checks for .gltf, .glb, .obj or .ply; throws a SceneError for other endings.
void check_mesh_ending(const std::string& path);
// Writes the surfaces as they are now: a mesh and a node for each part of each plant.
void write_mesh(const std::string& out, const Stage& stage);
// Writes the motion through all samples, at least two, as .gltf or .glb. Each sample is a morph target; one after the
// other has weight one.
void write_animation(const std::string& out, const Stage& stage, const std::vector<Sample>& samples);

}  // namespace frond::tools
