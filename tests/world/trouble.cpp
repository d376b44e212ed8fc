// Which plant had trouble, or was moved without a force, in the last substep.
#include <cmath>
#include <vector>

#include "frond/frond_snapshot.h"
#include "support/must.hpp"
#include "support/stems.hpp"

namespace trouble_tests {

using frond::test::must;

constexpr double H = 1.0 / 60;

uint32_t trouble_of(frond_plant plant) {
    uint32_t trouble = ~0u;
    must(frond_plant_get_trouble(plant, &trouble));
    return trouble;
}

uint32_t trouble_of(frond_world world) {
    frond_report report;
    must(frond_world_get_report(world, &report));
    return report.trouble;
}

// Two plants of stems, the second at `place`.
struct TwoPlants : SmallWorld {
    frond_plant second = {};
    explicit TwoPlants(frond_vec3 place, frond_mechanics mechanics = FROND_MECHANICS_ROD)
        : SmallWorld(def_of(mechanics, {0, 0, 0}), 0, FROND_REST_STANDS_AS_MODELLED) {
        const frond_plant_def def = def_of(mechanics, place);
        must(frond_plant_create(world, model, &def, &second));
    }
    static frond_plant_def def_of(frond_mechanics mechanics, frond_vec3 place) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        def.position = place;
        return def;
    }
    void step() const { must(frond_world_step(world, H)); }
};

TEST(Trouble, IsOfThePlantThatHasIt) {
    TwoPlants plants({3, 0, 0});
    EXPECT_EQ(trouble_of(plants.plant), 0u);
    plants.step();
    EXPECT_EQ(trouble_of(plants.plant), 0u);
    // Pins are put ten sizes of the plant away.
    must(frond_plant_pin(plants.second, 0));
    must(frond_plant_move_pin(plants.second, 0, {9, 0, 0}));
    plants.step();
    EXPECT_TRUE(trouble_of(plants.second) & FROND_TROUBLE_PASSED);
    EXPECT_EQ(trouble_of(plants.plant), 0u);
    EXPECT_TRUE(trouble_of(plants.world) & FROND_TROUBLE_PASSED);
    // It is of the last substep alone.
    for (int i = 0; i < 3; i++) plants.step();
    EXPECT_FALSE(trouble_of(plants.second) & FROND_TROUBLE_PASSED);
}

TEST(Trouble, IsEachPlantsOwnInAnyStep) {
    TwoPlants plants({3, 0, 0});
    frond_vec3 tip;
    must(frond_plant_get_tip(plants.second, &tip));
    frond_grab grab;
    must(frond_grab_create(plants.second, tip, 1e6, &grab));
    uint32_t all = 0;
    for (int i = 0; i < 60; i++) {
        must(frond_grab_move(grab, {tip.x + 0.5 * std::sin(0.7 * i), tip.y - 0.3 * (i % 2), tip.z}));
        plants.step();
        EXPECT_EQ(trouble_of(plants.plant), 0u) << i;
        EXPECT_EQ(trouble_of(plants.second) & 0xff, trouble_of(plants.world)) << i;
        all |= trouble_of(plants.world);
    }
    EXPECT_NE(all, 0u);
}

TEST(Trouble, TellsOfPlantsThatAreMovedApart) {
    TwoPlants plants({0.01, 0, 0.003});
    frond_plant third = {};
    const frond_plant_def def = TwoPlants::def_of(FROND_MECHANICS_ROD, {3, 0, 0});
    must(frond_plant_create(plants.world, plants.model, &def, &third));
    int parted = 0;
    for (int i = 0; i < 20; i++) {
        plants.step();
        parted += (trouble_of(plants.plant) & FROND_TROUBLE_PARTED) != 0;
        EXPECT_EQ(trouble_of(third), 0u) << i;
        EXPECT_FALSE(trouble_of(plants.world) & FROND_TROUBLE_PARTED) << "nothing went wrong";
    }
    EXPECT_GT(parted, 5);
}

// A blade of 6 by 60 cm that hangs by its end, and is pulled.
TEST(Trouble, TellsOfFibresThatPullBack) {
    const float half = 0.03f;
    std::vector<float> xyz;
    std::vector<int32_t> indices;
    for (int i = 0; i <= 12; i++)
        for (const float side : {-half, half}) xyz.insert(xyz.end(), {side, 0.05f * float(i), 0});
    for (int i = 0; i < 24; i += 2) indices.insert(indices.end(), {i, i + 1, i + 3, i, i + 3, i + 2});
    frond_model_def model_def = frond_default_model_def();
    model_def.scale = 1;
    model_def.up = {0, 1, 0};
    model_def.rest = FROND_REST_WITHOUT_GRAVITY;
    const frond_world_def world_def = frond_default_world_def();
    frond_world world;
    must(frond_world_create(&world_def, &world));
    frond_model model;
    must(frond_model_from_triangles(xyz.data(), int(xyz.size() / 3), indices.data(), int(indices.size() / 3),
                                    &model_def, &model));
    frond_plant_def def = TwoPlants::def_of(FROND_MECHANICS_TET_COROTATIONAL, {0, 1, 0});
    def.root_height = 0.03;
    def.rotation = {1, 0, 0, 0};
    std::vector<frond_plant> plants(2);
    for (frond_plant& plant : plants) {
        must(frond_plant_create(world, model, &def, &plant));
        def.position.x += 3;
    }
    must(frond_plant_set_effects(plants[1], FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_GRAVITY)));
    frond_grab grab;
    must(frond_grab_create(plants[0], {0, 0.4, 0}, 100, &grab));
    must(frond_grab_move(grab, {0, 0.2, 0}));
    for (int i = 0; i < 30; i++) must(frond_world_step(world, H));
    EXPECT_TRUE(trouble_of(plants[0]) & FROND_TROUBLE_TAUT);
    EXPECT_EQ(trouble_of(plants[1]), 0u);
    EXPECT_EQ(trouble_of(world), 0u);
    frond_world_destroy(world);
    frond_model_destroy(model);
}

TEST(Trouble, TellsOfChangesOfDetail) {
    TwoPlants plants({100, 0, 0}, FROND_MECHANICS_TET_COROTATIONAL);
    plants.step();
    must(frond_world_set_viewer(plants.world, {0, 1, 0}));
    plants.step();
    EXPECT_EQ(trouble_of(plants.plant), 0u);
    EXPECT_EQ(trouble_of(plants.second), uint32_t(FROND_TROUBLE_CHANGED_DETAIL));
    EXPECT_EQ(trouble_of(plants.world), 0u);
    plants.step();
    EXPECT_EQ(trouble_of(plants.second), 0u);
}

TEST(Trouble, IsForgottenWhereAPlantSleepsAndWhereAWorldIsRestored) {
    TwoPlants plants({3, 0, 0});
    std::vector<char> bytes(frond_world_get_snapshot_size(plants.world));
    must(frond_world_save(plants.world, bytes.data(), bytes.size()));
    must(frond_plant_pin(plants.second, 0));
    must(frond_plant_move_pin(plants.second, 0, {9, 0, 0}));
    plants.step();
    EXPECT_NE(trouble_of(plants.second), 0u);
    must(frond_world_restore(plants.world, bytes.data(), bytes.size()));
    EXPECT_EQ(trouble_of(plants.second), 0u);
    plants.step();
    EXPECT_EQ(trouble_of(plants.second), 0u);
    for (int i = 0; i < 600 && frond_plant_is_awake(plants.plant); i++) plants.step();
    EXPECT_FALSE(frond_plant_is_awake(plants.plant));
    plants.step();
    EXPECT_EQ(trouble_of(plants.plant), 0u);
}

TEST(Trouble, OfNoPlantIsRefused) {
    SmallWorld small;
    uint32_t trouble = 7;
    EXPECT_EQ(frond_plant_get_trouble({}, &trouble), FROND_RESULT_BAD_HANDLE);
    EXPECT_EQ(trouble, 0u);
    EXPECT_EQ(frond_plant_get_trouble(small.plant, nullptr), FROND_RESULT_BAD_ARGUMENT);
}

}  // namespace trouble_tests
