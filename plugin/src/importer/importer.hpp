// Importer: mesh file -> Surface, in its own process.
#pragma once

#include "importer/check.hpp"
#include "skeleton/organ_correct.hpp"
#include "surface/surface.hpp"

struct aiScene;
struct aiMaterial;

namespace frond {

Surface read_ply(const MeshFile& file);
// Reads a file MESH.frond.json; errors begin with its name.
Corrections read_corrections(const std::string& path);
// Reads the file through assimp.
Surface read_scene(const MeshFile& file);
// Stores what the file declares in Surface::scale, scale_declared, up and up_declared. Returns the transform that
// assimp has not applied yet, to metres.
Eigen::Matrix4d take_frame(const aiScene& scene, const MeshFile& file, Surface& surface);
Surface take_scene(const aiScene& scene, const MeshFile& file);

// Rewrites glTF that assimp cannot read as it is: quantized attributes become floats, WebP textures plain ones. Returns
// the bytes to read instead; empty if the file needs no change.
std::string rewrite_gltf(const MeshFile& file);
// Likewise for OBJ: drops numbers of "v" lines beyond position and colour, and names the material library of the file's
// own name if there is one and the file names none. For Collada: removes blanks before numbers.
std::string rewrite_obj(const MeshFile& file);
std::string rewrite_dae(const MeshFile& file);

// Returns the real path of a file that a model refers to, "" if there is none. Only files inside the model's folder are
// found: by the path as written, else by the bare file name, whatever its case.
std::string find_beside(const std::string& folder, const std::string& reference);
// Return the index of the texture in the surface, which is read on first use; -1 with a warning if it is not available.
int take_texture(Surface& surface, const std::string& name, const std::string& bytes);
int take_texture_file(Surface& surface, const MeshFile& file, const std::string& reference);

// Finds out what a texture's alpha cuts out: Texture::opacity. Leaves what cannot be decoded as it is.
void find_opacity(Texture& texture);

// Guesses the texture of a material that names none: a picture near the model with the name of the material or, failing
// that, of the model ("bark_diffuse.png", "fern.png" for fern.obj). Returns its index in the surface; -1 if there is
// none.
int guess_texture(Surface& surface, const MeshFile& file, const std::string& material);

// Reads base colour and texture of a material; has_uvs: the mesh has texture coordinates.
void take_material(const aiScene& scene, const aiMaterial& material, const MeshFile& file, bool has_uvs,
                   Surface& surface, Part& part);

// Returns whether the alpha of a material's texture cuts out what is drawn: glTF says so, other formats have no word
// for it.
bool counts_alpha(const aiMaterial& material, const MeshFile& file);

// Convert sRGB to linear and back, 0..1.
float linear_of(float srgb);
float srgb_of(float linear);

// Vertices as read, before equal ones are merged. An empty array: the file has no such values.
struct Corners {
    std::vector<Vec3> positions;  // in double: map coordinates are too large for float
    std::vector<Vec3f> normals;
    std::vector<Vec2f> uvs;
    std::vector<Color> colors;
    std::vector<Triangle> triangles;
};
// Merges vertices that agree in all values; the first one stays. Turns one vertex per face corner into render vertices.
void weld_corners(Corners& corners);
// Appends the corners to the surface as a part.
void append_part(Surface& surface, const Corners& corners, const Part& part);

}  // namespace frond
