// Takes the look of a material: base colour (linear) and base-colour texture, embedded or from the model's folder.
// glTF's factors are linear already; what other formats hold are display colours.
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "core/log.hpp"
#include "importer/importer.hpp"

namespace frond {

float linear_of(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

float srgb_of(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

static float in_range(float value) {
    return value >= 0 ? std::min(value, 1.0f) : 0.0f;
}

static bool is_tint(const aiColor4D& color) {
    constexpr float LEAST = 0.05f;
    return std::max({color.r, color.g, color.b}) - std::min({color.r, color.g, color.b}) > LEAST;
}

// An embedded texture's bytes, or those of a file beside the model; -1 if there is none.
static int find_texture(const aiScene& scene, const aiMaterial& material, const MeshFile& file, Surface& surface) {
    for (aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE, aiTextureType_AMBIENT}) {
        aiString path;
        if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) continue;
        const aiTexture* embedded = scene.GetEmbeddedTexture(path.C_Str());
        if (!embedded) return take_texture_file(surface, file, path.C_Str());
        if (embedded->mHeight != 0 || embedded->mWidth == 0 || !embedded->pcData) {
            warn("the embedded texture %s is not an image file and is left out", path.C_Str());
            return -1;
        }
        const std::string bytes(reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth);
        const std::string name = embedded->mFilename.length ? embedded->mFilename.C_Str() : path.C_Str();
        return take_texture(surface, name + (path.C_Str()[0] == '*' ? path.C_Str() : ""), bytes);
    }
    return -1;
}

void take_material(const aiScene& scene, const aiMaterial& material, const MeshFile& file, Surface& surface,
                   Part& part) {
    const bool is_gltf = file.format == FileFormat::GLTF || file.format == FileFormat::GLB;
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && std::string(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME)
        part.material = name.C_Str();
    part.texture = find_texture(scene, material, file, surface);

    aiColor4D color(1, 1, 1, 1);
    const bool has_base = material.Get(AI_MATKEY_BASE_COLOR, color) == aiReturn_SUCCESS;
    const bool has_color = has_base || material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS;
    // Instead of the colour a texture stands in formats other than glTF, but in MTL files, where it is tinted. Greys
    // there are what exporters write when nobody chose a colour.
    if (part.texture >= 0 && !is_gltf) {
        part.color = {1, 1, 1, 1};
        if (file.format == FileFormat::OBJ && has_color && is_tint(color))
            for (size_t i = 0; i < 3; ++i) part.color[i] = linear_of(in_range(color[unsigned(i)]));
        return;
    }
    // The materials that assimp makes up say nothing: for meshes without one, for STL, and its grey for OBJ files whose
    // material library is missing.
    const bool is_made_up = file.format == FileFormat::OBJ && color == aiColor4D(0.6f, 0.6f, 0.6f, color.a);
    if (!has_color || is_made_up || file.format == FileFormat::STL || (!is_gltf && part.material.empty())) {
        if (part.texture >= 0 || (is_gltf && !part.material.empty())) part.color = {1, 1, 1, 1};
        return;
    }
    const float channels[3] = {in_range(color.r), in_range(color.g), in_range(color.b)};
    for (size_t i = 0; i < 3; ++i) part.color[i] = is_gltf ? channels[i] : linear_of(channels[i]);

    // A plant that is not there at all is a mistake of the exporter.
    float opacity = is_gltf ? color.a : 1.0f;
    if (!is_gltf) material.Get(AI_MATKEY_OPACITY, opacity);
    part.color[3] = opacity >= 0.05f ? in_range(opacity) : 1.0f;
}

}  // namespace frond
