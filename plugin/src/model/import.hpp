// Import: files and the caller's arrays -> Surface (or tets). The only place that sees assimp.
#pragma once

#include "model/cage.hpp"

namespace frond {

struct ImportOptions {
    double scale = 0;        // 0: guess
    Vec3 up = Vec3::Zero();  // zero: guess
    std::string name = {};   // of the file, which may say what plant it is
};

// A tet mesher's output: nodes and tets as they stand, and their boundary as surface.
struct TetMesh {
    std::vector<Vec3> nodes;
    std::vector<Tet> tets;
    std::vector<int> tet_region;       // index into regions
    std::vector<std::string> regions;  // names, at least one
};

// Mesh files, through assimp in a child process with limits: see import_process.cpp. The surface comes placed and
// clean.
Surface import_surface(const std::string& path, const ImportOptions& options);
// Gmsh .msh (2.2 and 4.1, text and binary) and legacy .vtk unstructured grids.
bool is_tet_file(const std::string& path);
TetMesh import_tets(const std::string& path);

// Scales and turns to metres and +y up, guessing what the options leave open; then cleans. A surface that was placed
// before is left alone.
void place_surface(Surface& surface, const ImportOptions& options);
// The same for bare points, without guessing an up axis and without cleaning; scale and up are noted in the surface.
void place_points(std::vector<Vec3>& points, const ImportOptions& options, Surface& surface);
Surface surface_from_triangles(const float* xyz, int vertex_count, const int32_t* indices, int triangle_count);
// Tubes with rounded ends around the pieces; one part a stem. In metres and +y up as given, unless placed otherwise.
Surface surface_from_stems(const frond_stem* stems, int stem_count);
// Checks, orients, scales and turns the tets; their boundary becomes the surface, bound to its own nodes. An up of zero
// is +y: tets are simulated as they are. Nodes that no tet uses are dropped.
void take_tets(TetMesh mesh, const ImportOptions& options, Surface& surface, Cage& cage, Embedding& embedding);

}  // namespace frond
