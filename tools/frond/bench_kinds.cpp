// Part of frond bench field: cost of a step of plants of one kind in wind, each by itself and batched in the
// processor's lanes.
#include <cmath>
#include <cstdio>
#include <iterator>

#include "bench.hpp"
#include "quantile.hpp"

namespace frond::tools {

namespace {

// Plants of one kind, in a wind.
struct Kind {
    const char* name;
    frond_model model;
    frond_mechanics mechanics;
    int count;
    double wind;  // [m/s]
};

struct KindFigures {
    double ms;  // median of a step
    uint64_t hash;
    int elements;
};

KindFigures measure_kind(const Kind& kind, bool in_lanes) {
    constexpr int WARM_UP = 20, STEPS = 60, SIDE = 32;
    constexpr double H = 1.0 / 60;
    const frond_world_def world_def = frond_default_world_def();
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = {kind.wind, 0, 0};
    must(frond_world_set_wind(world, &wind));
    KindFigures figures = {};
    for (int i = 0; i < kind.count; i++) {
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = kind.mechanics;
        def.effects &= ~uint32_t(FROND_EFFECT_PLANT_CONTACT);
        def.position = {0.7 * (i % SIDE), 0, 0.7 * (i / SIDE)};
        def.rotation = {0, std::sin(0.1 * i), 0, std::cos(0.1 * i)};
        // Only plants of the same settings share lanes; a direct solver ignores this one.
        if (!in_lanes) def.tuning.linear_tolerance *= 1 + 1e-3 * i;
        frond_plant plant = {};
        must(frond_plant_create(world, kind.model, &def, &plant));
        figures.elements = frond_plant_get_capsule_count(plant);
    }
    if (kind.mechanics != FROND_MECHANICS_ROD) {
        frond_cage_view cage = {};
        must(frond_model_get_cage(kind.model, &cage));
        figures.elements = cage.tet_count;
    }
    std::vector<double> ms;
    for (int i = 0; i < WARM_UP + STEPS; i++) {
        const double begin = now();
        must(frond_world_step(world, H));
        if (i >= WARM_UP) ms.push_back(now() - begin);
    }
    figures.ms = median(ms);
    must(frond_world_get_state_hash(world, &figures.hash));
    frond_world_destroy(world);
    return figures;
}

// Returns the model of a stem with two branches.
frond_model small_cage() {
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.4, 0}, 0.008, 0.006},
                                {0, {0, 0.4, 0}, {0.02, 0.8, 0}, 0.006, 0.003},
                                {0, {0, 0.4, 0}, {0.3, 0.6, 0.1}, 0.004, 0.002}};
    frond_model_def def = frond_default_model_def();
    def.capsule_height = 0.08;
    def.cage_size = 0.1;
    frond_model model = {};
    must(frond_model_from_stems(stems, int(std::size(stems)), &def, &model));
    return model;
}

}  // namespace

void bench_kinds() {
    frond_model_def def = frond_default_model_def();
    frond_model corn = {}, short_pieces = {};
    must(frond_model_load(model_path("corn/corn.obj").c_str(), &def, &corn));
    def.capsule_height = 0.4;
    must(frond_model_load(model_path("corn/corn.obj").c_str(), &def, &short_pieces));
    const frond_model small = small_cage();
    const Kind kinds[] = {{"corn, rods", short_pieces, FROND_MECHANICS_ROD, 1000, 6},
                          {"corn, cages", corn, FROND_MECHANICS_TET_COROTATIONAL, 200, 2},
                          {"corn, cages", corn, FROND_MECHANICS_TET_COROTATIONAL, 200, 6},
                          {"stems, cages", small, FROND_MECHANICS_TET_COROTATIONAL, 1000, 2},
                          {"stems, cages", small, FROND_MECHANICS_TET_COROTATIONAL, 1000, 6}};
    std::printf("\nplants of one kind in a wind, median of a step [ms]\n%14s %7s %9s %11s %14s %9s\n", "", "plants",
                "elements", "wind [m/s]", "one at a time", "in lanes");
    for (const Kind& kind : kinds) {
        const KindFigures alone = measure_kind(kind, false), lanes = measure_kind(kind, true);
        std::printf("%14s %7d %9d %11.0f %14.2f %9.2f  %.2f times as quick, %s\n", kind.name, kind.count,
                    lanes.elements, kind.wind, alone.ms, lanes.ms, alone.ms / lanes.ms,
                    alone.hash == lanes.hash ? "bits are the same" : "bits DIFFER");
        std::fflush(stdout);
    }
    for (frond_model model : {corn, short_pieces, small}) frond_model_destroy(model);
}

}  // namespace frond::tools
