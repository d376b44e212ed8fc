// In: a stage, and samples of its motion. Out: mesh files, by assimp. Its exporter writes morph targets but not the
// time course of their weights, which is added to the file afterwards.
#include <assimp/material.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "export.hpp"

namespace frond::tools {

std::ofstream open_to_write(const std::string& path, bool binary) {
    std::ofstream file(path, binary ? std::ios::binary : std::ios::out);
    if (!file) throw SceneError(path + " cannot be written; does its folder exist?");
    return file;
}

void close(std::ofstream& file, const std::string& path) {
    file.close();
    if (!file) throw SceneError(path + " could not be written whole; is the disk full?");
}

namespace {

// Returns assimp's name of the format with a file name's ending.
const char* format_of(const std::string& path) {
    static const std::map<std::string, const char*> FORMATS = {
        {".gltf", "gltf2"}, {".glb", "glb2"}, {".obj", "obj"}, {".ply", "plyb"}};
    const auto found = FORMATS.find(std::filesystem::path(path).extension().string());
    if (found == FORMATS.end()) throw SceneError(path + ": surfaces are written as .gltf .glb .obj .ply");
    return found->second;
}

// Writes a texture beside the mesh, with its bytes unchanged.
std::string write_texture(const std::string& out, frond_model model, int texture) {
    frond_texture_view view;
    must(frond_model_get_texture(model, texture, &view));
    const std::filesystem::path mesh = out;
    const bool is_jpeg = view.byte_count > 1 && view.bytes[0] == 0xff && view.bytes[1] == 0xd8;
    const std::string name = mesh.stem().string() + "_" + std::to_string(texture) + (is_jpeg ? ".jpg" : ".png");
    const std::string path = (mesh.parent_path() / name).string();
    std::ofstream file = open_to_write(path, true);
    file.write(reinterpret_cast<const char*>(view.bytes), std::streamsize(view.byte_count));
    close(file, path);
    return name;
}

aiMaterial* material_of(const frond_part& part, const std::string& texture) {
    auto* material = new aiMaterial;
    const aiString name(part.organ);
    const aiColor4D color(part.color[0], part.color[1], part.color[2], part.color[3]);
    material->AddProperty(&name, AI_MATKEY_NAME);
    material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&color, 1, AI_MATKEY_BASE_COLOR);
    const int both_sides = 1;
    material->AddProperty(&both_sides, 1, AI_MATKEY_TWOSIDED);
    if (texture.empty()) return material;
    const aiString file(texture);
    material->AddProperty(&file, AI_MATKEY_TEXTURE(aiTextureType_DIFFUSE, 0));
    return material;
}

// Returns the entries of `from` for the numbered vertices, in the order of their numbers.
aiVector3D* take(const std::map<int32_t, unsigned>& number, const float* from) {
    auto* out = new aiVector3D[number.size()];
    for (const auto& [vertex, own] : number) {
        const float* p = from + 3 * size_t(vertex);
        out[own] = {p[0], p[1], p[2]};
    }
    return out;
}

// Makes a part's mesh of the vertices that its triangles use, in their order, with one morph target per sample of the
// plant.
aiMesh* mesh_of(const frond_surface_view& view, const frond_part& part, size_t plant,
                const std::vector<Sample>& samples) {
    const int32_t* corners = view.indices + 3 * size_t(part.first_triangle);
    const size_t corner_count = 3 * size_t(part.triangle_count);
    std::map<int32_t, unsigned> number;
    for (size_t i = 0; i < corner_count; i++) number.emplace(corners[i], 0u);
    unsigned count = 0;
    for (auto& [vertex, own] : number) own = count++;

    auto* mesh = new aiMesh;
    mesh->mName = part.organ;
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    mesh->mNumVertices = count;
    mesh->mVertices = take(number, view.positions);
    mesh->mNormals = take(number, view.normals);
    if (view.uvs) {
        mesh->mTextureCoords[0] = new aiVector3D[count];
        mesh->mNumUVComponents[0] = 2;
        // assimp's v = 0 is the bottom row.
        for (const auto& [vertex, own] : number)
            mesh->mTextureCoords[0][own] = {view.uvs[2 * vertex], 1 - view.uvs[2 * vertex + 1], 0};
    }
    mesh->mNumFaces = unsigned(part.triangle_count);
    mesh->mFaces = new aiFace[mesh->mNumFaces];
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        mesh->mFaces[f].mNumIndices = 3;
        mesh->mFaces[f].mIndices = new unsigned[3];
        for (unsigned k = 0; k < 3; k++) mesh->mFaces[f].mIndices[k] = number.at(corners[3 * f + k]);
    }
    if (samples.empty()) return mesh;
    mesh->mNumAnimMeshes = unsigned(samples.size());
    mesh->mAnimMeshes = new aiAnimMesh*[samples.size()];
    for (size_t s = 0; s < samples.size(); s++) {
        aiAnimMesh* target = mesh->mAnimMeshes[s] = new aiAnimMesh;
        target->mName = "at " + std::to_string(samples[s].time) + " s";
        target->mNumVertices = count;
        target->mVertices = take(number, samples[s].places[plant].data());
        target->mNormals = take(number, samples[s].normals[plant].data());
    }
    return mesh;
}

void export_scene(const std::string& out, const Stage& stage, const std::vector<Sample>& samples) {
    const char* format = format_of(out);
    std::vector<aiMesh*> meshes;
    std::vector<aiMaterial*> materials;
    for (size_t i = 0; i < stage.plants.size(); i++) {
        frond_surface_view view;
        frond_model_info info;
        must(frond_plant_get_surface(stage.plants[i], &view));
        must(frond_model_get_info(stage.plant_models[i], &info));
        std::map<int, std::string> textures;
        for (int p = 0; p < info.part_count; p++) {
            frond_part part;
            must(frond_model_get_part(stage.plant_models[i], p, &part));
            if (part.texture >= 0 && !textures.count(part.texture))
                textures[part.texture] = write_texture(out, stage.plant_models[i], part.texture);
            materials.push_back(material_of(part, part.texture >= 0 ? textures[part.texture] : ""));
            meshes.push_back(mesh_of(view, part, i, samples));
            meshes.back()->mMaterialIndex = unsigned(materials.size() - 1);
        }
    }
    aiScene scene;
    const unsigned count = unsigned(meshes.size());
    scene.mNumMeshes = scene.mNumMaterials = count;
    scene.mMeshes = new aiMesh*[count];
    scene.mMaterials = new aiMaterial*[count];
    scene.mRootNode = new aiNode("plants");
    scene.mRootNode->mNumChildren = count;
    scene.mRootNode->mChildren = new aiNode*[count];
    for (unsigned i = 0; i < count; i++) {
        scene.mMeshes[i] = meshes[i];
        scene.mMaterials[i] = materials[i];
        aiNode* node = scene.mRootNode->mChildren[i] = new aiNode(meshes[i]->mName.C_Str());
        node->mParent = scene.mRootNode;
        node->mNumMeshes = 1;
        node->mMeshes = new unsigned[1]{i};
    }
    Assimp::ExportProperties properties;
    properties.SetPropertyBool("GLTF2_TARGET_NORMAL_EXP", true);
    Assimp::Exporter exporter;
    if (exporter.Export(&scene, format, out, 0, &properties) != aiReturn_SUCCESS)
        throw SceneError(out + " could not be written: " + exporter.GetErrorString());
}

// ---- an animation added to a glTF file ----------------------------------------------------------------------------

std::string read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw SceneError(path + " was written but cannot be read");
    return std::string(std::istreambuf_iterator<char>(file), {});
}

void write_whole(const std::string& path, const std::string& bytes) {
    std::ofstream file = open_to_write(path, true);
    file.write(bytes.data(), std::streamsize(bytes.size()));
    close(file, path);
}

std::string word(size_t value) {
    const uint32_t number = uint32_t(value);
    return std::string(reinterpret_cast<const char*>(&number), 4);
}

std::string padded(std::string bytes, char with) {
    bytes.resize((bytes.size() + 3) / 4 * 4, with);
    return bytes;
}

// JSON and buffer of a glTF file, whether in one file (.glb) or two (.gltf).
struct Gltf {
    nlohmann::json json;
    std::string bytes;  // contents of its one buffer
};

constexpr size_t GLB_HEAD = 12, CHUNK_HEAD = 8;

Gltf read_gltf(const std::string& path, bool is_binary) {
    Gltf gltf;
    const std::string all = read_whole(path);
    if (!is_binary) {
        gltf.json = nlohmann::json::parse(all);
        const std::string name = gltf.json["buffers"][0]["uri"];
        gltf.bytes = read_whole((std::filesystem::path(path).parent_path() / name).string());
        return gltf;
    }
    uint32_t json_size = 0;
    std::memcpy(&json_size, all.data() + GLB_HEAD, 4);
    gltf.json = nlohmann::json::parse(all.substr(GLB_HEAD + CHUNK_HEAD, json_size));
    gltf.bytes = all.substr(GLB_HEAD + 2 * CHUNK_HEAD + json_size);
    return gltf;
}

void write_gltf(const std::string& path, bool is_binary, const Gltf& gltf) {
    if (!is_binary) {
        const std::string name = gltf.json["buffers"][0]["uri"];
        write_whole((std::filesystem::path(path).parent_path() / name).string(), gltf.bytes);
        return write_whole(path, gltf.json.dump(1));
    }
    const std::string json = padded(gltf.json.dump(), ' '), bytes = padded(gltf.bytes, '\0');
    const size_t size = GLB_HEAD + 2 * CHUNK_HEAD + json.size() + bytes.size();
    write_whole(path, "glTF" + word(2) + word(size) + word(json.size()) + "JSON" + json + word(bytes.size()) +
                          std::string("BIN\0", 4) + bytes);
}

// Appends numbers to the buffer; returns their accessor.
size_t add_numbers(Gltf& gltf, const std::vector<float>& numbers) {
    gltf.bytes = padded(gltf.bytes, '\0');
    gltf.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", gltf.bytes.size()}, {"byteLength", 4 * numbers.size()}});
    gltf.json["accessors"].push_back({{"bufferView", gltf.json["bufferViews"].size() - 1},
                                      {"componentType", 5126},
                                      {"count", numbers.size()},
                                      {"type", "SCALAR"}});
    gltf.bytes.append(reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size());
    gltf.json["buffers"][0]["byteLength"] = gltf.bytes.size();
    return gltf.json["accessors"].size() - 1;
}

}  // namespace

Sample sample_of(const Stage& stage) {
    Sample sample;
    sample.time = stage.time;
    for (const frond_plant plant : stage.plants) {
        frond_surface_view view;
        must(frond_plant_get_surface(plant, &view));
        const size_t count = 3 * size_t(view.vertex_count);
        sample.places.emplace_back(view.positions, view.positions + count);
        sample.normals.emplace_back(view.normals, view.normals + count);
    }
    return sample;
}

void check_mesh_ending(const std::string& path) {
    format_of(path);
}

void write_mesh(const std::string& out, const Stage& stage) {
    export_scene(out, stage, {});
}

void write_animation(const std::string& out, const Stage& stage, const std::vector<Sample>& samples) {
    const bool is_binary = std::strcmp(format_of(out), "glb2") == 0;
    if (!is_binary && std::strcmp(format_of(out), "gltf2") != 0)
        throw SceneError(out + ": animations are written as .gltf .glb");
    if (samples.size() < 2) throw SceneError(out + ": nothing moves within no time; say --at SECONDS");
    export_scene(out, stage, samples);
    Gltf gltf = read_gltf(out, is_binary);
    std::vector<float> times, weights(samples.size() * samples.size(), 0);
    for (size_t s = 0; s < samples.size(); s++) {
        times.push_back(float(samples[s].time));
        weights[s * samples.size() + s] = 1;
    }
    const size_t input = add_numbers(gltf, times), output = add_numbers(gltf, weights);
    gltf.json["accessors"][input]["min"] = {times.front()};
    gltf.json["accessors"][input]["max"] = {times.back()};
    nlohmann::json channels = nlohmann::json::array();
    for (size_t node = 0; node < gltf.json["nodes"].size(); node++)
        if (gltf.json["nodes"][node].count("mesh"))
            channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    gltf.json["animations"] = {{{"name", "plants"},
                                {"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}},
                                {"channels", channels}}};
    write_gltf(out, is_binary, gltf);
}

}  // namespace frond::tools
