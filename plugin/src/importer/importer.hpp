// Importer: mesh file -> Surface, in a process of its own.
#pragma once

#include "importer/check.hpp"
#include "model/surface.hpp"

struct aiScene;
struct aiMaterial;

namespace frond {

Surface read_ply(const MeshFile& file);
// Through assimp.
Surface read_scene(const MeshFile& file);
Surface take_scene(const aiScene& scene, const MeshFile& file);

// glTF that assimp cannot read as it stands but could: quantized attributes become floats, WebP textures plain ones.
// The bytes to read instead; empty if the file is good as it is.
std::string rewrite_gltf(const MeshFile& file);
// Likewise OBJ lines "v" with more numbers than a place and a colour and an OBJ file that names no material library but
// has one of its own name beside it; and blanks in front of Collada's numbers.
std::string rewrite_obj(const MeshFile& file);
std::string rewrite_dae(const MeshFile& file);

// The real path of a file that a model refers to, "" if there is none. Only files inside the model's folder are found:
// by the path as written, else by the bare file name, upper or lower case.
std::string find_beside(const std::string& folder, const std::string& reference);
// Index of the texture in the surface, read on first use; -1 with a warning if it cannot be had.
int take_texture(Surface& surface, const std::string& name, const std::string& bytes);
int take_texture_file(Surface& surface, const MeshFile& file, const std::string& reference);

// The texture of a material that names none: a picture beside the model that is called like the material or, failing
// that, like the model ("bark_diffuse.png", "fern.png" for fern.obj). Index in the surface; -1 if there is none.
int guess_texture(Surface& surface, const MeshFile& file, const std::string& material);

// Base colour and texture of a material; has_uvs: the mesh has texture coordinates.
void take_material(const aiScene& scene, const aiMaterial& material, const MeshFile& file, bool has_uvs,
                   Surface& surface, Part& part);

// sRGB <-> linear, 0..1.
float linear_of(float srgb);
float srgb_of(float linear);

// Vertices as they come, before equal ones are made one. Empty arrays: none.
struct Corners {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
    std::vector<Color> colors;
    std::vector<Triangle> triangles;
};
// Makes vertices one that agree in all they have; the first stays. Turns a vertex per face corner into render vertices.
void weld_corners(Corners& corners);
// Adds them as a part.
void append_part(Surface& surface, const Corners& corners, const Part& part);

}  // namespace frond
