// Import: files and the caller's arrays -> Surface (or tets). The library leaves assimp to the import program.
#pragma once

#include "cage/cage.hpp"
#include "skeleton/organ_correct.hpp"

namespace frond {

struct ImportOptions {
    double scale = 0;        // metres per file unit; 0: guessed
    Vec3 up = Vec3::Zero();  // up axis of the file; zero: guessed
    std::string name = {};   // name of the file, which may name the plant
    // File with corrections; empty: none, "beside": MESH.frond.json in the mesh's folder, if it is there.
    std::string corrections = {};
};

// Output of a tet mesher: nodes and tets as given.
struct TetMesh {
    std::vector<Vec3> nodes;
    std::vector<Tet> tets;
    std::vector<int> tet_region;       // index into regions
    std::vector<std::string> regions;  // names, at least one
};

// Imports a mesh file, through assimp in a child process with limits: see import_process.cpp. The surface is placed and
// clean. `corrections`: receives those of options.corrections, or null.
Surface import_surface(const std::string& path, const ImportOptions& options, Corrections* corrections = nullptr);
// Tet files: Gmsh .msh (2.2 and 4.1, text and binary) and legacy .vtk unstructured grids.
bool is_tet_file(const std::string& path);
TetMesh import_tets(const std::string& path);

// Scales and rotates to metres and +y up, guessing what the options leave open; then cleans. A surface that was placed
// before is not changed.
void place_surface(Surface& surface, const ImportOptions& options);
// The same for points alone, without guessing an up axis and without cleaning; stores scale and up in the surface.
void place_points(std::vector<Vec3>& points, const ImportOptions& options, Surface& surface);
Surface surface_from_triangles(const float* xyz, int vertex_count, const int32_t* indices, int triangle_count);
// Makes tubes with rounded ends around the stems, one part per stem. In metres and +y up as given, unless placed
// otherwise.
Surface surface_from_stems(const frond_stem* stems, int stem_count);
// Checks, orients, scales and rotates the tets; their boundary becomes the surface, attached to its own nodes. An up of
// zero means +y: tets are simulated as they are. Nodes that no tet uses are dropped.
void take_tets(TetMesh mesh, const ImportOptions& options, Surface& surface, Cage& cage, Embedding& embedding);

}  // namespace frond
