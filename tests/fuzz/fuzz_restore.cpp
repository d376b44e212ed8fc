// Target: frond_world_restore, mostly with a header whose length and checksum are repaired after the bytes' changes.
#include "fuzz/input.hpp"

using namespace frond::fuzz;

namespace {

constexpr size_t LENGTH_AT = 32, CHECKSUM_AT = 40, HEAD = 48;

struct Garden {
    frond_world world = {};
    std::vector<frond_plant> plants;
    std::vector<uint8_t> snapshot;
    Garden() {
        frond_set_log(nullptr, nullptr);
        const frond_world_def def = frond_default_world_def();
        require(frond_world_create(&def, &world) == FROND_OK, "no world");
        const double nodes[] = {0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0.3, 0};
        const int32_t tets[] = {0, 1, 2, 3};
        const frond_model_def model_def = frond_default_model_def();
        frond_model model = {};
        require(frond_model_from_tets(nodes, 4, tets, 1, &model_def, &model) == FROND_OK, "no model");
        for (frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD}) {
            frond_plant_def plant_def = frond_default_plant_def();
            plant_def.mechanics = mechanics;
            plant_def.position = {0.05 * double(plants.size()), 0, 0};
            plants.emplace_back();
            require(frond_plant_create(world, model, &plant_def, &plants.back()) == FROND_OK, "no plant");
        }
        frond_rigid_def ball = frond_default_rigid_def();
        ball.state.position = {-0.12, 0.15, 0};
        ball.state.velocity = {1, 0, 0};
        frond_rigid rigid = {};
        require(frond_rigid_create(world, &ball, &rigid) == FROND_OK, "no ball");
        for (int i = 0; i < 4; i++) require(frond_world_step(world, 1.0 / 60) == FROND_OK, "no step");
        snapshot.resize(frond_world_get_snapshot_size(world));
        require(frond_world_save(world, snapshot.data(), snapshot.size()) == FROND_OK, "not saved");
    }
};

}  // namespace

// The bytes select positions in the snapshot and what is written there, so that small inputs reach far.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static Garden garden;
    Input input = {data, size};
    std::vector<uint8_t> bytes = garden.snapshot;
    const bool mends_head = input.byte() % 8 != 0;
    while (!input.is_empty()) {
        const size_t at = input.raw<uint16_t>() % bytes.size();
        damage(input, at, bytes);
    }
    if (mends_head && bytes.size() >= HEAD) {
        uint64_t length = bytes.size() - HEAD, checksum = 0xcbf29ce484222325u;
        for (size_t i = HEAD; i < bytes.size(); i++) checksum = (checksum ^ bytes[i]) * 0x100000001b3u;
        std::memcpy(&bytes[LENGTH_AT], &length, sizeof length);
        std::memcpy(&bytes[CHECKSUM_AT], &checksum, sizeof checksum);
    }
    const frond_result result = frond_world_restore(garden.world, bytes.data(), bytes.size());
    require(result == FROND_OK || result == FROND_RESULT_FILE_FORMAT || result == FROND_RESULT_BAD_ARGUMENT,
            "an unexpected result");
    for (int i = 0; i < 2; i++)
        require(frond_world_step(garden.world, 1.0 / 60) == FROND_OK, "the world does not step any more");
    for (frond_plant plant : garden.plants) require_finite(plant);
    return 0;
}
