// A model that was saved and loaded again is the model that was built, to the last bit; other bytes are refused.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/stems.hpp"

namespace cooked_tests {

using Bytes = std::vector<uint8_t>;

frond_model load(const std::string& path) {
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    EXPECT_EQ(frond_model_load(path.c_str(), &def, &model), FROND_OK) << frond_last_error();
    return model;
}

frond_model built(const char* name) {
    return load(std::string(FROND_SOURCE_DIR "/models/") + name);
}

Bytes bytes_of(frond_model model) {
    Bytes bytes(frond_model_get_saved_size(model));
    EXPECT_EQ(frond_model_save_bytes(model, bytes.data(), bytes.size()), FROND_OK) << frond_last_error();
    return bytes;
}

frond_model from_bytes(const Bytes& bytes) {
    frond_model model = {};
    EXPECT_EQ(frond_model_load_bytes(bytes.data(), bytes.size(), &model), FROND_OK) << frond_last_error();
    return model;
}

// Expects a refusal whose text has a word.
void expect_refused(const Bytes& bytes, const char* word) {
    frond_model model = {1};
    ASSERT_EQ(frond_model_load_bytes(bytes.data(), bytes.size(), &model), FROND_RESULT_FILE_FORMAT) << word;
    EXPECT_EQ(model.id, 0u);
    EXPECT_NE(std::strstr(frond_last_error(), word), nullptr) << frond_last_error();
}

struct Way {
    frond_mechanics mechanics;
    int order;
};

// Blows at one plant and returns the world's hash.
uint64_t hash_after(frond_model model, const Way& way, int steps) {
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    frond_plant plant = {};
    EXPECT_EQ(frond_world_create(&world_def, &world), FROND_OK);
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = way.mechanics;
    def.element_order = way.order;
    EXPECT_EQ(frond_plant_create(world, model, &def, &plant), FROND_OK) << frond_last_error();
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {6, 0, 1};
    EXPECT_EQ(frond_world_set_wind(world, &wind), FROND_OK);
    for (int i = 0; i < steps; i++) EXPECT_EQ(frond_world_step(world, 1.0 / 60), FROND_OK);
    uint64_t hash = 0;
    EXPECT_EQ(frond_world_get_state_hash(world, &hash), FROND_OK);
    frond_world_destroy(world);
    return hash;
}

class Cooked : public ::testing::TestWithParam<const char*> {};

TEST_P(Cooked, StepsToTheBitsOfTheModelThatWasBuilt) {
    const frond_model model = built(GetParam()), again = from_bytes(bytes_of(model));
    for (const Way& way : {Way{FROND_MECHANICS_TET_COROTATIONAL, 1}, Way{FROND_MECHANICS_ROD, 1}})
        EXPECT_EQ(hash_after(again, way, 300), hash_after(model, way, 300)) << way.mechanics;
    frond_model_destroy(model);
    frond_model_destroy(again);
}

TEST_P(Cooked, IsTheSameAgainWhenItIsCookedAgain) {
    const frond_model model = built(GetParam());
    const Bytes bytes = bytes_of(model);
    EXPECT_EQ(bytes_of(model), bytes);
    const frond_model again = from_bytes(bytes);
    EXPECT_EQ(bytes_of(again), bytes);
    // It does not hang on the one that it came from.
    frond_model_info before, after;
    ASSERT_EQ(frond_model_get_info(model, &before), FROND_OK);
    frond_model_destroy(model);
    ASSERT_EQ(frond_model_get_info(again, &after), FROND_OK);
    EXPECT_EQ(after.capsule_count, before.capsule_count);
    EXPECT_EQ(after.mass, before.mass);
    EXPECT_EQ(after.texture_count, before.texture_count);
    EXPECT_EQ(after.min_dihedral, before.min_dihedral);
    frond_model_destroy(again);
}

INSTANTIATE_TEST_SUITE_P(Files, Cooked,
                         ::testing::Values("corn/corn.obj", "cucumber/cucumber.obj", "wheat/wheat.obj",
                                           "sunflower/sunflower.obj", "urdf/sapling.urdf", "urdf/seedling.urdf"),
                         [](const ::testing::TestParamInfo<const char*>& info) {
                             const std::string path = info.param;
                             return path.substr(path.find('/') + 1, path.find('.') - path.find('/') - 1);
                         });

TEST(CookedModel, KeepsWhatOtherMechanicsFound) {
    const frond_model model = make_small_model(0, FROND_REST_STANDS_AS_MODELLED);
    const size_t plain = frond_model_get_saved_size(model);
    std::vector<uint64_t> hashes;
    const Way ways[] = {
        {FROND_MECHANICS_TET_NEOHOOKEAN, 1}, {FROND_MECHANICS_TET_COROTATIONAL, 2}, {FROND_MECHANICS_SPRING_CHAIN, 1}};
    for (const Way& way : ways) hashes.push_back(hash_after(model, way, 60));
    const Bytes bytes = bytes_of(model);
    EXPECT_GT(bytes.size(), plain);
    const frond_model again = from_bytes(bytes);
    for (size_t i = 0; i < hashes.size(); i++) EXPECT_EQ(hash_after(again, ways[i], 60), hashes[i]) << i;
    EXPECT_EQ(bytes_of(again), bytes);
    // What it does not hold yet is found when it is needed.
    const frond_model early = make_small_model(0, FROND_REST_STANDS_AS_MODELLED), late = from_bytes(bytes_of(early));
    EXPECT_EQ(hash_after(late, ways[0], 60), hashes[0]);
    for (frond_model m : {model, again, early, late}) frond_model_destroy(m);
}

TEST(CookedModel, HoldsTetsOfTheCaller) {
    const double nodes[] = {0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0.3, 0};
    const int32_t tets[] = {0, 1, 2, 3};
    const frond_model_def def = frond_default_model_def();
    frond_model model = {};
    ASSERT_EQ(frond_model_from_tets(nodes, 4, tets, 1, &def, &model), FROND_OK) << frond_last_error();
    const frond_model again = from_bytes(bytes_of(model));
    const Way way = {FROND_MECHANICS_TET_COROTATIONAL, 1};
    EXPECT_EQ(hash_after(again, way, 60), hash_after(model, way, 60));
    frond_model_destroy(model);
    frond_model_destroy(again);
}

TEST(CookedModel, IsAFileUnderAnyName) {
    const std::string path = testing::TempDir() + "frond_cooked.bin";
    const frond_model model = make_small_model();
    ASSERT_EQ(frond_model_save(model, path.c_str()), FROND_OK) << frond_last_error();
    std::ifstream file(path, std::ios::binary);
    const Bytes read((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(read, bytes_of(model));
    const frond_model again = load(path);
    EXPECT_EQ(bytes_of(again), read);

    // It is as it was built.
    frond_model_def def = frond_default_model_def();
    def.cage_size = 0.1;
    frond_model other = {1};
    EXPECT_EQ(frond_model_load(path.c_str(), &def, &other), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_NE(std::strstr(frond_last_error(), "cage_size"), nullptr) << frond_last_error();
    EXPECT_EQ(other.id, 0u);

    // A damaged file is named.
    std::filesystem::resize_file(path, read.size() - 1);
    def = frond_default_model_def();
    EXPECT_EQ(frond_model_load(path.c_str(), &def, &other), FROND_RESULT_FILE_FORMAT);
    EXPECT_NE(std::strstr(frond_last_error(), "frond_cooked.bin"), nullptr) << frond_last_error();
    std::remove(path.c_str());
    EXPECT_EQ(frond_model_save(model, "/none/plant.frond"), FROND_RESULT_FILE_NOT_FOUND);
    frond_model_destroy(model);
    frond_model_destroy(again);
}

TEST(CookedModel, IsRefusedWhenItIsNotWhole) {
    const frond_model model = make_small_model();
    const Bytes bytes = bytes_of(model);
    const size_t head = 56;
    for (size_t size : {size_t(1), size_t(7)})
        expect_refused(Bytes(bytes.begin(), bytes.begin() + long(size)), "not a cooked");
    expect_refused(Bytes(bytes.begin(), bytes.begin() + 20), "header");
    for (size_t size = head; size < bytes.size(); size += 1 + bytes.size() / 50)
        expect_refused(Bytes(bytes.begin(), bytes.begin() + long(size)), "declares");
    for (size_t at = head; at < bytes.size(); at += 1 + bytes.size() / 200) {
        Bytes changed = bytes;
        changed[at] ^= uint8_t(1u << at % 8);
        expect_refused(changed, "checksum");
    }
    Bytes longer = bytes;
    longer.push_back(0);
    expect_refused(longer, "declares");
    frond_model_destroy(model);
}

TEST(CookedModel, OfAnotherVersionIsRefusedByItsName) {
    const frond_model model = make_small_model();
    Bytes bytes = bytes_of(model);
    std::memcpy(&bytes[8], "0.1.7", 6);
    frond_model_destroy(from_bytes(bytes));  // the same layout
    Bytes layout = bytes, types = bytes;
    layout[24]++;
    types[32] ^= 1;
    expect_refused(layout, "Frond 0.1.7");
    expect_refused(types, "cook it anew");
    bytes[0] = 'f';
    expect_refused(bytes, "not a cooked model");
    frond_model_destroy(model);
}

TEST(CookedModel, MisuseIsRefused) {
    const frond_model model = make_small_model();
    Bytes bytes(frond_model_get_saved_size(model));
    EXPECT_EQ(frond_model_save_bytes(model, bytes.data(), bytes.size() - 1), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_save_bytes(model, nullptr, bytes.size()), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_save_bytes({}, bytes.data(), bytes.size()), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_save(model, nullptr), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(frond_model_save({}, "x"), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(frond_model_get_saved_size({}), 0u);
    frond_model out = {1};
    EXPECT_EQ(frond_model_load_bytes(nullptr, 10, &out), FROND_RESULT_BAD_ARGUMENT);
    EXPECT_EQ(out.id, 0u);
    EXPECT_EQ(frond_model_load_bytes(bytes.data(), bytes.size(), nullptr), FROND_RESULT_BAD_ARGUMENT);
    frond_model_destroy(model);
}

}  // namespace cooked_tests
