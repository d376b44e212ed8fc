// Reads the appearance of a material: base colour (linear) and base-colour texture, embedded or from the model's
// folder. A material without a colour keeps the default of a new part, which the colour of the organ's kind replaces
// later.
// glTF's factors are linear already, as are the colours that Blender writes in any format; other programs write display
// colours.
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <initializer_list>

#include "core/elementary.hpp"
#include "core/log.hpp"
#include "importer/importer.hpp"

namespace frond {

float linear_of(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : float(frond::pow((srgb + 0.055) / 1.055, 2.4));
}

float srgb_of(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : float(1.055 * frond::pow(linear, 1 / 2.4) - 0.055);
}

static float in_range(float value) {
    return value >= 0 ? std::min(value, 1.0f) : 0.0f;
}

// Returns whether a colour is a tint. Grey, black and white are what exporters write when nobody chose a colour.
static bool is_tint(const aiColor4D& color) {
    constexpr float LEAST = 0.05f;  // difference of channels that can be seen [-]
    return std::max({color.r, color.g, color.b}) - std::min({color.r, color.g, color.b}) > LEAST;
}

static bool is_black(const aiColor4D& color) {
    return std::max({color.r, color.g, color.b}) < 0.005f;
}

static bool is_gltf(const MeshFile& file) {
    return file.format == FileFormat::GLTF || file.format == FileFormat::GLB;
}

// Returns whether colours are linear: in glTF, and in files by Blender, which states its name near the beginning.
static bool has_linear_colors(const MeshFile& file) {
    constexpr size_t HEADER = 16384;  // beginning in which it stands [byte]
    return is_gltf(file) || file.bytes.substr(0, HEADER).find("Blender") != std::string::npos;
}

static std::array<float, 4> linear_color(const aiColor4D& color, const MeshFile& file) {
    const bool is_linear = has_linear_colors(file);
    std::array<float, 4> out = {in_range(color.r), in_range(color.g), in_range(color.b), 1};
    for (size_t i = 0; i < 3 && !is_linear; ++i) out[i] = linear_of(out[i]);
    return out;
}

// Takes an embedded texture, or a file near the model. Returns its index in the surface; -1 if it is not available.
static int take_reference(const aiScene& scene, const aiString& path, const MeshFile& file, Surface& surface) {
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

// A material's values as read, before defaults are recognized.
struct Look {
    aiColor4D color{1, 1, 1, 1};
    bool has_color = false, has_reference = false;  // has_reference: names a texture, found or not
};

static Look read_look(const aiScene& scene, const aiMaterial& material, const MeshFile& file, Surface& surface,
                      Part& part) {
    Look look;
    look.has_color = material.Get(AI_MATKEY_BASE_COLOR, look.color) == aiReturn_SUCCESS ||
                     material.Get(AI_MATKEY_COLOR_DIFFUSE, look.color) == aiReturn_SUCCESS;
    const auto take_first = [&](std::initializer_list<aiTextureType> types) {
        aiString path;
        for (aiTextureType type : types) {
            if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0) continue;
            part.texture = take_reference(scene, path, file, surface);
            return true;
        }
        return false;
    };
    look.has_reference = take_first({aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE, aiTextureType_AMBIENT});
    // A material that emits light and reflects none is drawn unshaded: its base colour is what it emits.
    aiColor4D emitted(0, 0, 0, 1);
    material.Get(AI_MATKEY_COLOR_EMISSIVE, emitted);
    if (!look.has_reference && look.has_color && is_black(look.color) && !is_black(emitted)) {
        look.has_reference = take_first({aiTextureType_EMISSIVE});
        look.color = aiColor4D(emitted.r, emitted.g, emitted.b, look.color.a);
    }
    return look;
}

bool counts_alpha(const aiMaterial& material, const MeshFile& file) {
    aiString mode;
    return !is_gltf(file) ||
           (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS && std::string(mode.C_Str()) != "OPAQUE");
}

void take_material(const aiScene& scene, const aiMaterial& material, const MeshFile& file, bool has_uvs,
                   Surface& surface, Part& part) {
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && std::string(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME)
        part.material = name.C_Str();
    const Look look = read_look(scene, material, file, surface, part);
    const bool is_plain = !is_tint(look.color);
    if (part.texture < 0 && has_uvs && is_plain && !is_gltf(file))
        part.texture = guess_texture(surface, file, part.material);

    // In formats other than glTF the texture replaces the colour, but in MTL files a colour tints the texture.
    if (part.texture >= 0 && !is_gltf(file)) {
        part.color = {1, 1, 1, 1};
        if (file.format == FileFormat::OBJ && look.has_color && !is_plain) part.color = linear_color(look.color, file);
        return;
    }
    // Materials that assimp makes up are ignored: for meshes without one, for STL, and its grey for OBJ files whose
    // material library is missing. So is grey or white under a texture that was not found.
    const bool is_made_up = !look.has_color || file.format == FileFormat::STL ||
                            (!is_gltf(file) && part.material.empty()) ||
                            (file.format == FileFormat::OBJ && look.color == aiColor4D(0.6f, 0.6f, 0.6f, look.color.a));
    if (is_made_up || (look.has_reference && part.texture < 0 && is_plain)) {
        if (part.texture >= 0) part.color = {1, 1, 1, 1};
        return;
    }
    part.color = linear_color(look.color, file);

    // A fully transparent plant is a mistake of the exporter.
    float opacity = is_gltf(file) ? look.color.a : 1.0f;
    if (!is_gltf(file)) material.Get(AI_MATKEY_OPACITY, opacity);
    part.color[3] = opacity >= 0.05f ? in_range(opacity) : 1.0f;
}

}  // namespace frond
