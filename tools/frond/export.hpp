// Export: files that other programs read, of what stands on a stage.
#pragma once

#include <fstream>

#include "scenes/scene.hpp"

namespace frond::tools {

// Both throw a SceneError that names the file.
std::ofstream open_to_write(const std::string& path, bool binary = false);
void close(std::ofstream& file, const std::string& path);

// Surfaces of all plants at a moment.
struct Sample {
    double time;                                      // [s]
    std::vector<std::vector<float>> places, normals;  // of each plant, its vertices' [m]
};
Sample sample_of(const Stage& stage);

// .gltf .glb .obj .ply; throws a SceneError for other endings.
void check_mesh_ending(const std::string& path);
// Surfaces as they are now: a mesh and a node for each part of each plant.
void write_mesh(const std::string& out, const Stage& stage);
// The way through all samples, at least two: .gltf .glb. Each sample is a morph target, of which one after the other
// has weight one.
void write_animation(const std::string& out, const Stage& stage, const std::vector<Sample>& samples);

}  // namespace frond::tools
