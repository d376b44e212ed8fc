// Plants of stems through the C API, in metres and y up.
#pragma once

#include <gtest/gtest.h>

#include "frond/frond.h"

// Makes a model of stems of one material; null takes the preset's.
inline frond_model make_stems_of(const frond_stem* stems, int count, const frond_material* material, frond_rest rest,
                                 double capsule_height = 0) {
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = rest;
    def.capsule_height = capsule_height;
    const frond_organ_material organ = {"stem", material ? *material : frond_material{}};
    if (material) {
        def.organs = &organ;
        def.organ_count = 1;
    }
    frond_model model = {};
    EXPECT_EQ(frond_model_from_stems(stems, count, &def, &model), FROND_OK) << frond_last_error();
    return model;
}
// Does so with a stem's preset; young: 0 takes the preset's [Pa].
inline frond_model make_stems(const frond_stem* stems, int count, double young,
                              frond_rest rest = frond_default_model_def().rest) {
    frond_material material;
    EXPECT_EQ(frond_material_preset("stem", &material), FROND_OK) << frond_last_error();
    if (young > 0) material.young = young;
    return make_stems_of(stems, count, young > 0 ? &material : nullptr, rest);
}

// A stem of 0.6 m with a side branch. It is modelled without gravity, so that it is at rest in free fall, unless it is
// to stand as modelled.
inline frond_model make_small_model(double young = 0, frond_rest rest = FROND_REST_WITHOUT_GRAVITY) {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.3, 0}, 0.02, 0.015},
                                {0, {0, 0.3, 0}, {0, 0.6, 0}, 0.015, 0.01},
                                {0, {0, 0.3, 0}, {0.2, 0.45, 0}, 0.01, 0.005}};
    return make_stems(stems, 3, young, rest);
}

struct SmallWorld {
    frond_world world = {};
    frond_model model = {};
    frond_plant plant = {};
    explicit SmallWorld(const frond_plant_def& plant_def = frond_default_plant_def(), double young = 0,
                        frond_rest rest = FROND_REST_WITHOUT_GRAVITY) {
        const frond_world_def def = frond_default_world_def();
        EXPECT_EQ(frond_world_create(&def, &world), FROND_OK) << frond_last_error();
        model = make_small_model(young, rest);
        EXPECT_EQ(frond_plant_create(world, model, &plant_def, &plant), FROND_OK) << frond_last_error();
    }
    ~SmallWorld() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
};
