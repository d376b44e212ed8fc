// Target: cooked models, mostly with a header whose length and checksum are repaired after the bytes' changes, and a
// few steps of the plants that they give.
#include <algorithm>

#include "fuzz/input.hpp"

using namespace frond::fuzz;

namespace {

constexpr size_t LENGTH_AT = 40, CHECKSUM_AT = 48, HEAD = 56;

// Small models with rest shapes of several mechanics.
struct Kitchen {
    frond_world world = {};
    std::vector<std::vector<uint8_t>> cooked;
    Kitchen() {
        frond_set_log(nullptr, nullptr);
        const frond_world_def def = frond_default_world_def();
        require(frond_world_create(&def, &world) == FROND_OK, "no world");
        const frond_model_def model_def = frond_default_model_def();
        const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.3, 0}, 0.02, 0.015},
                                    {0, {0, 0.3, 0}, {0.15, 0.5, 0}, 0.012, 0.006}};
        const double nodes[] = {0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0.3, 0};
        const int32_t tets[] = {0, 1, 2, 3};
        frond_model model = {};
        require(frond_model_from_stems(stems, 2, &model_def, &model) == FROND_OK, "no model of stems");
        take(model);
        require(frond_model_from_tets(nodes, 4, tets, 1, &model_def, &model) == FROND_OK, "no model of tets");
        take(model);
    }
    void take(frond_model model) {
        for (const int order : {1, 2}) {
            frond_plant_def def = frond_default_plant_def();
            def.mechanics = FROND_MECHANICS_TET_NEOHOOKEAN;
            def.element_order = order;
            frond_plant plant = {};
            require(frond_plant_create(world, model, &def, &plant) == FROND_OK, "no plant");
            frond_plant_destroy(plant);
        }
        cooked.emplace_back(frond_model_get_saved_size(model));
        require(frond_model_save_bytes(model, cooked.back().data(), cooked.back().size()) == FROND_OK, "not saved");
        require(frond_model_save(model, "/none/of/this") == FROND_RESULT_FILE_NOT_FOUND, "saved nowhere");
        frond_model_destroy(model);
    }
};

void mend_head(std::vector<uint8_t>& bytes) {
    if (bytes.size() < HEAD) return;
    uint64_t length = bytes.size() - HEAD, checksum = 0xcbf29ce484222325u ^ length;
    for (size_t at = HEAD; at < bytes.size(); at += 8) {
        uint64_t word = 0;
        std::memcpy(&word, &bytes[at], std::min<size_t>(8, bytes.size() - at));
        checksum = (checksum ^ word) * 0x100000001b3u;
        checksum ^= checksum >> 29;
    }
    std::memcpy(&bytes[LENGTH_AT], &length, sizeof length);
    std::memcpy(&bytes[CHECKSUM_AT], &checksum, sizeof checksum);
}

void try_plants(frond_world world, frond_model model, Input& input) {
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = frond_mechanics(input.below(FROND_MECHANICS_COUNT));
    def.element_order = 1 + input.below(2);
    frond_plant plant = {};
    if (frond_plant_create(world, model, &def, &plant) != FROND_OK) return;
    for (int i = 0; i < 2; i++) require(frond_world_step(world, 1.0 / 60) == FROND_OK, "no step");
    require_finite(plant);
    frond_surface_view view = {};
    require(frond_plant_get_surface(plant, &view) == FROND_OK, "no surface");
    frond_plant_destroy(plant);
}

}  // namespace

// The bytes select positions in a cooked model and what is written there, so that small inputs reach far.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static Kitchen kitchen;
    Input input = {data, size};
    std::vector<uint8_t> bytes = kitchen.cooked[size_t(input.below(int(kitchen.cooked.size())))];
    const bool mends_head = input.byte() % 8 != 0;
    Input plants = input;
    while (!input.is_empty()) {
        const size_t at = input.raw<uint32_t>() % bytes.size();
        damage(input, at, bytes);
    }
    if (mends_head) mend_head(bytes);
    frond_model model = {1};
    const frond_result result = frond_model_load_bytes(bytes.data(), bytes.size(), &model);
    if (result != FROND_OK) {
        require(result == FROND_RESULT_FILE_FORMAT && model.id == 0 && frond_last_error()[0] != 0,
                "an unexpected result");
        return 0;
    }
    frond_model_info info = {};
    require(frond_model_get_info(model, &info) == FROND_OK && info.mass > 0, "no info");
    try_plants(kitchen.world, model, plants);
    frond_model_destroy(model);
    return 0;
}
