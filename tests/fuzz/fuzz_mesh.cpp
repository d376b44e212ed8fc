// Target: mesh files and arrays, from import to a cage, and a step of the plant.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/input.hpp"

using namespace frond::fuzz;

namespace {

void try_model(frond_result result, frond_model model) {
    if (result != FROND_OK) {
        require(model.id == 0 && frond_last_error()[0] != 0, "a failed call left a model, or no text");
        require(result != FROND_RESULT_INTERNAL, "an internal error");
        return;
    }
    static const frond_world world = [] {
        const frond_world_def def = frond_default_world_def();
        frond_world made = {};
        require(frond_world_create(&def, &made) == FROND_OK, "no world");
        return made;
    }();
    const frond_plant_def def = frond_default_plant_def();
    frond_plant plant = {};
    if (frond_plant_create(world, model, &def, &plant) == FROND_OK) {
        require(frond_world_step(world, 1.0 / 60) == FROND_OK, "no step");
        require_finite(plant);
        frond_plant_destroy(plant);
    }
    frond_model_destroy(model);
}

// A def with default values in most fields.
struct RandomDef {
    frond_organ_material organ = {};
    frond_model_def def = frond_default_model_def();
    explicit RandomDef(Input& input) {
        const auto change = [&](double& value) {
            if (input.below(8) == 0) value = input.number();
        };
        for (double* value : {&def.scale, &def.capsule_height, &def.capsule_radius, &def.cage_size, &def.cage_offset,
                              &def.cage_smoothness, &def.allow_stiffening})
            change(*value);
        if (input.below(8) == 0) def.up = input.vec();
        if (input.below(8) == 0) def.rest = frond_rest(input.below(FROND_REST_COUNT + 1));
        if (input.below(4) != 0) return;
        static const char* const KINDS[] = {"stem", "blade", "fruit", "no_such_kind"};
        organ.organ = KINDS[input.below(4)];
        frond_material_preset("stem", &organ.material);
        for (size_t at = 0; at < sizeof organ.material / sizeof(double); at++) change((&organ.material.density)[at]);
        def.organs = &organ;
        def.organ_count = 1;
    }
};

void try_file(Input& input) {
    static const char* const ENDS[] = {"obj", "ply", "stl", "gltf", "glb", "dae", "fbx", "msh", "vtk"};
    static const std::string base =
        (std::filesystem::temp_directory_path() / ("frond_fuzz_" + std::to_string(getpid()) + ".")).string();
    const std::string path = base + ENDS[input.below(9)];
    // The def is the default one, so that all bytes go to the file.
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(input.data), long(input.left));
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    const frond_result result = frond_model_load(path.c_str(), &def, &model);
    std::remove(path.c_str());
    try_model(result, model);
}

void try_triangles(Input& input) {
    const int vertices = 3 + input.below(40), triangles = 1 + input.below(60);
    std::vector<float> xyz(3 * size_t(vertices));
    std::vector<int32_t> indices(3 * size_t(triangles));
    for (float& value : xyz) value = float(input.number());
    for (int32_t& index : indices) index = input.byte() < 250 ? input.below(vertices) : input.integer();
    const RandomDef random(input);
    frond_model model = {};
    const frond_result result =
        frond_model_from_triangles(xyz.data(), vertices, indices.data(), triangles, &random.def, &model);
    try_model(result, model);
}

void try_tets(Input& input) {
    const int nodes = 4 + input.below(20), tets = 1 + input.below(20);
    std::vector<double> xyz(3 * size_t(nodes));
    std::vector<int32_t> corners(4 * size_t(tets));
    for (double& value : xyz) value = input.number();
    for (int32_t& corner : corners) corner = input.byte() < 250 ? input.below(nodes) : input.integer();
    const RandomDef random(input);
    frond_model model = {};
    const frond_result result = frond_model_from_tets(xyz.data(), nodes, corners.data(), tets, &random.def, &model);
    try_model(result, model);
}

void try_stems(Input& input) {
    std::vector<frond_stem> stems(size_t(1 + input.below(12)));
    for (size_t i = 0; i < stems.size(); i++) {
        stems[i].parent = input.byte() < 250 ? int(i) - 1 - input.below(3) : input.integer();
        stems[i].begin = input.vec();
        stems[i].end = input.vec();
        stems[i].radius_begin = input.number();
        stems[i].radius_end = input.number();
    }
    const RandomDef random(input);
    frond_model model = {};
    const frond_result result = frond_model_from_stems(stems.data(), int(stems.size()), &random.def, &model);
    try_model(result, model);
    std::vector<frond_stem_section> sections(stems.size());
    for (frond_stem_section& section : sections)
        section = {frond_outline(input.below(FROND_OUTLINE_COUNT)),
                   input.number(),
                   input.number(),
                   input.vec(),
                   input.number(),
                   input.number(),
                   input.number(),
                   input.number()};
    frond_model shaped = {};
    try_model(frond_model_from_stem_sections(stems.data(), sections.data(), int(stems.size()), &random.def, &shaped),
              shaped);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    frond_set_log(nullptr, nullptr);
    Input input = {data, size};
    switch (input.below(4)) {
        case 0:
            try_file(input);
            break;
        case 1:
            try_triangles(input);
            break;
        case 2:
            try_tets(input);
            break;
        default:
            try_stems(input);
    }
    return 0;
}
