// frond export SCENE|FILE: steps a scene and writes what came of it for other programs: the surface as a mesh file, its way
// there as a vertex cache, states as a table, the plant as URDF.
#include <assimp/material.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "commands.hpp"
#include "frond/frond_robot.h"
#include "scenes/scene.hpp"

namespace frond::tools {
namespace {

struct ExportOptions {
    std::string what, out, csv, cache, urdf;
    double at = 0;  // [s]
    std::vector<std::string> assignments;
};

std::ofstream open_to_write(const std::string& path, bool binary = false) {
    std::ofstream file(path, binary ? std::ios::binary : std::ios::out);
    if (!file) throw SceneError(path + " cannot be written; does its folder exist?");
    return file;
}

void close(std::ofstream& file, const std::string& path) {
    file.close();
    if (!file) throw SceneError(path + " could not be written whole; is the disk full?");
}

// ---- mesh files ---------------------------------------------------------------------------------------------------

// What assimp calls the format of a file name's ending.
const char* format_of(const std::string& path) {
    static const std::map<std::string, const char*> FORMATS = {
        {".gltf", "gltf2"}, {".glb", "glb2"}, {".obj", "obj"}, {".ply", "plyb"}};
    const auto found = FORMATS.find(std::filesystem::path(path).extension().string());
    if (found == FORMATS.end()) throw SceneError(path + ": surfaces are written as .gltf .glb .obj .ply");
    return found->second;
}

// Textures are written beside the mesh as they came.
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

// The vertices that a part's triangles use, in their order.
aiMesh* mesh_of(const frond_surface_view& view, const frond_part& part) {
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
    mesh->mVertices = new aiVector3D[count];
    mesh->mNormals = new aiVector3D[count];
    if (view.uvs) {
        mesh->mTextureCoords[0] = new aiVector3D[count];
        mesh->mNumUVComponents[0] = 2;
    }
    for (const auto& [vertex, own] : number) {
        const float *p = view.positions + 3 * size_t(vertex), *n = view.normals + 3 * size_t(vertex);
        mesh->mVertices[own] = {p[0], p[1], p[2]};
        mesh->mNormals[own] = {n[0], n[1], n[2]};
        // assimp's v = 0 is the bottom row.
        if (view.uvs) mesh->mTextureCoords[0][own] = {view.uvs[2 * vertex], 1 - view.uvs[2 * vertex + 1], 0};
    }
    mesh->mNumFaces = unsigned(part.triangle_count);
    mesh->mFaces = new aiFace[mesh->mNumFaces];
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        mesh->mFaces[f].mNumIndices = 3;
        mesh->mFaces[f].mIndices = new unsigned[3];
        for (unsigned k = 0; k < 3; k++) mesh->mFaces[f].mIndices[k] = number.at(corners[3 * f + k]);
    }
    return mesh;
}

// All plants' parts, one mesh and one node each.
void write_mesh(const std::string& out, const Stage& stage) {
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
            meshes.push_back(mesh_of(view, part));
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
    Assimp::Exporter exporter;
    if (exporter.Export(&scene, format, out) != aiReturn_SUCCESS)
        throw SceneError(out + " could not be written: " + exporter.GetErrorString());
}

// ---- what happens until then ----------------------------------------------------------------------------------------

// Vertices of all plants, a sample a step, as a point cache that Blender and Maya lay onto the mesh of the first one: PC2,
// little-endian.
class PointCache {
public:
    PointCache(const std::string& path, double rate) : path(path), rate(float(rate)), file(open_to_write(path, true)) {
        write_head(0, 0);
    }
    void add(const Stage& stage) {
        int count = 0;
        for (frond_plant plant : stage.plants) {
            frond_surface_view view;
            must(frond_plant_get_surface(plant, &view));
            file.write(reinterpret_cast<const char*>(view.positions), std::streamsize(12) * view.vertex_count);
            count += view.vertex_count;
        }
        samples++;
        points = count;
    }
    void finish() {
        file.seekp(0);
        write_head(points, samples);
        close(file, path);
    }

private:
    void write_head(int32_t point_count, int32_t sample_count) {
        const int32_t version = 1;
        const float start = 0;
        file.write("POINTCACHE2\0", 12);
        file.write(reinterpret_cast<const char*>(&version), 4);
        file.write(reinterpret_cast<const char*>(&point_count), 4);
        file.write(reinterpret_cast<const char*>(&start), 4);
        file.write(reinterpret_cast<const char*>(&rate), 4);
        file.write(reinterpret_cast<const char*>(&sample_count), 4);
    }
    std::string path;
    float rate;  // samples a frame of 1/24 s
    std::ofstream file;
    int32_t points = 0, samples = 0;
};

// A line a step and plant: time, tip, force and moment of the ground, energies, contacts.
class Table {
public:
    explicit Table(const std::string& path) : path(path), file(open_to_write(path)) {
        file << "time,plant,tip_x,tip_y,tip_z,root_force_x,root_force_y,root_force_z,root_moment_x,root_moment_y,"
                "root_moment_z,kinetic,elastic,gravity,contacts\n";
    }
    void add(const Stage& stage) {
        for (size_t i = 0; i < stage.plants.size(); i++) {
            frond_vec3 tip, force, moment;
            frond_energy energy;
            must(frond_plant_get_tip(stage.plants[i], &tip));
            must(frond_plant_get_root_force(stage.plants[i], stage.places[i], &force, &moment));
            must(frond_plant_get_energy(stage.plants[i], &energy));
            char line[512];
            std::snprintf(line, sizeof line, "%.9g,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n",
                          stage.time, i, tip.x, tip.y, tip.z, force.x, force.y, force.z, moment.x, moment.y, moment.z,
                          energy.kinetic, energy.elastic, energy.gravity, frond_plant_get_contact_count(stage.plants[i]));
            file << line;
        }
    }
    void finish() { close(file, path); }

private:
    std::string path;
    std::ofstream file;
};

void run(const ExportOptions& options) {
    if (options.out.empty() && options.csv.empty() && options.cache.empty() && options.urdf.empty())
        throw SceneError("nothing to write; name a file with --out, --cache, --csv or --urdf");
    if (!options.out.empty()) format_of(options.out);
    const Casting casting = cast(options.what);
    const Settings settings = settings_of(casting, options.assignments);
    Play play(casting, settings);
    std::unique_ptr<Table> table;
    std::unique_ptr<PointCache> cache;
    if (!options.csv.empty()) table = std::make_unique<Table>(options.csv);
    if (!options.cache.empty()) cache = std::make_unique<PointCache>(options.cache, 1 / (24 * settings.dt));
    const auto note = [&] {
        if (table) table->add(play.stage);
        if (cache) cache->add(play.stage);
    };
    note();
    for (int i = 0; i < int(std::lround(options.at / settings.dt)); i++) {
        play.step();
        note();
    }
    if (table) table->finish();
    if (cache) cache->finish();
    if (!options.out.empty()) write_mesh(options.out, play.stage);
    if (!options.urdf.empty()) must(frond_model_write_urdf(play.stage.plant_models[0], options.urdf.c_str()));
}

}  // namespace

void add_export(CLI::App& app) {
    auto options = std::make_shared<ExportOptions>();
    CLI::App* command = app.add_subcommand("export", "write what becomes of a scene or plant file, for other programs");
    command->add_option("what", options->what, "a mesh file, or a scene as for run")->required();
    command->add_option("--out", options->out, "surface of all plants: .gltf .glb .obj .ply");
    command->add_option("--at", options->at, "when [s], default 0")->check(CLI::Range(0.0, 1e6));
    command->add_option("--cache", options->cache, "places of all vertices at each step until then: .pc2");
    command->add_option("--csv", options->csv, "tip, forces at the root, energies at each step until then");
    command->add_option("--urdf", options->urdf, "the first plant as it was modelled, as links and joints");
    command->add_option("--set", options->assignments, "key=value, may be repeated");
    command->footer("Keys of --set:\n" + settings_help());
    command->callback([options] { run(*options); });
}

}  // namespace frond::tools
