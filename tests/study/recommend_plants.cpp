// frond_recommend keeps its promised errors on plants of other shapes than beams: each is built and simulated as
// advised, and its tip compared with that of the finest chain that its shape allows, in far shorter steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scenes/vector.hpp"
#include "study/trial.hpp"

using namespace frond::study;
using frond::tools::dot;
using frond::tools::length;
using frond::tools::operator-;
using frond::tools::operator+;
using frond::tools::operator*;

namespace recommend_plants_tests {

using Path = std::vector<frond_vec3>;

// A kind of plant, built with capsules of any length.
struct Kind {
    std::function<ModelPtr(double capsule_height)> build;
    bool has_weight;
    double finest;  // length of a capsule of the reference [m]; 0: as advised
};

// A plant alone in its world.
class Alone {
public:
    Alone(const ModelPtr& model, const frond_plant_def& plant_def, bool has_weight) : model(model) {
        frond_world_def def = frond_default_world_def();
        def.gravity = {0, has_weight ? -9.81 : 0, 0};
        def.max_substep = 1;
        def.sleep_distance = 0;
        must(frond_world_create(&def, &world));
        must(frond_plant_create(world, model->handle, &plant_def, &plant));
        find_tip();
    }
    ~Alone() { frond_world_destroy(world); }
    Alone(const Alone&) = delete;
    Alone& operator=(const Alone&) = delete;

    double reach = 0;  // way to the tip along the chain [m]

    frond_vec3 displacement() const { return states()[size_t(tip)].position - rest; }
    // Finds the shape at rest under a force on the tip: each step of a second damps all but slow motion away.
    std::vector<frond_chain_state> bend(const frond_vec3& force) {
        for (int i = 0; i < 25; i++) {
            must(frond_plant_add_chain_load(plant, tip, force, {0, 0, 0}));
            must(frond_world_step(world, 1));
        }
        std::vector<frond_chain_state> bent = states();
        for (frond_chain_state& state : bent) state.velocity = state.angular_velocity = {0, 0, 0};
        return bent;
    }
    // Returns the tip's displacement at the start and after each step.
    Path sway(const std::vector<frond_chain_state>& from, double dt, int steps, int keep_every = 1) {
        must(frond_plant_set_chain_state(plant, from.data(), int(from.size())));
        Path path = {displacement()};
        for (int i = 1; i <= steps; i++) {
            must(frond_world_step(world, dt));
            if (i % keep_every == 0) path.push_back(displacement());
        }
        return path;
    }

private:
    std::vector<frond_chain_state> states() const {
        std::vector<frond_chain_state> all(size_t(frond_plant_get_chain_node_count(plant)));
        must(frond_plant_get_chain_state(plant, all.data(), int(all.size())));
        return all;
    }
    void find_tip() {
        frond_chain_view view;
        must(frond_model_get_chain(model->handle, &view));
        const auto place = [&](int i) {
            return frond_vec3{view.nodes[3 * i], view.nodes[3 * i + 1], view.nodes[3 * i + 2]};
        };
        std::vector<double> ways(size_t(view.node_count), 0.0);
        for (int i = 0; i < view.node_count; i++)
            if (const int parent = view.parents[i]; parent >= 0)
                ways[size_t(i)] = ways[size_t(parent)] + length(place(i) - place(parent));
        reach = *std::max_element(ways.begin(), ways.end());
        while (ways[size_t(tip)] < (1 - 1e-6) * reach) tip++;
        rest = place(tip);
    }

    ModelPtr model;
    frond_world world = {};
    frond_plant plant = {};
    int tip = 0;
    frond_vec3 rest = {};
};

// Returns the same plant without damping, and without a render mesh, which takes most of the time.
frond_plant_def undamped(frond_plant_def def) {
    def.effects &= ~uint32_t(FROND_EFFECT_DAMPING | FROND_EFFECT_SURFACE | FROND_EFFECT_NORMALS);
    return def;
}
frond_plant_def patient(frond_plant_def def) {
    def = undamped(def);
    def.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    def.tuning.newton_iterations = 10;
    def.tuning.newton_tolerance = 1e-10;
    return def;
}
frond_plant_def exact_rods() {
    frond_plant_def def = undamped(frond_default_plant_def());
    def.mechanics = FROND_MECHANICS_ROD;
    def.integrator = FROND_INTEGRATOR_SDIRK2;
    def.tuning.mass = FROND_MASS_CONSISTENT;
    return def;
}

// Returns the horizontal force that bends the tip aside by a thousandth of its way, where it gives way most.
frond_vec3 find_force(const ModelPtr& model, bool has_weight) {
    constexpr double SMALL = 1e-5;  // [N]
    Alone plant(model, patient(exact_rods()), has_weight);
    plant.bend({SMALL, 0, 0});
    const frond_vec3 by_x = plant.displacement();
    plant.bend({0, 0, SMALL});
    const frond_vec3 by_z = plant.displacement();
    const double angle = 0.5 * std::atan2(by_x.z + by_z.x, by_x.x - by_z.z);
    const double c = std::cos(angle), s = std::sin(angle);
    const frond_vec3 both = c * by_x + s * by_z;
    const double force = SMALL * 1e-3 * plant.reach / length(both);
    return {force * c, 0, force * s};
}

// Returns the period of the largest part of a long record, by a Fourier transform under Hann's window [s].
double main_period(const Path& path, double dt) {
    const double duration = dt * double(path.size());
    double best = 0, largest = 0;
    for (double turns = 2; turns < 40; turns += 0.02) {
        frond_vec3 cosine = {0, 0, 0}, sine = {0, 0, 0};
        for (size_t i = 0; i < path.size(); i++) {
            const double share = double(i) / double(path.size());
            const double window = 1 - std::cos(2 * M_PI * share), phase = 2 * M_PI * turns * share;
            const double c = window * std::cos(phase), s = window * std::sin(phase);
            cosine = cosine + c * path[i];
            sine = sine + s * path[i];
        }
        const double part = dot(cosine, cosine) + dot(sine, sine);
        if (part <= largest) continue;
        largest = part;
        best = turns;
    }
    return duration / best;
}

double find_period(const ModelPtr& model, bool has_weight, const frond_vec3& force) {
    Alone patient_one(model, patient(exact_rods()), has_weight);
    const auto bent = patient_one.bend(force);
    Alone plant(model, exact_rods(), has_weight);
    const Path first = plant.sway(bent, 1e-3, 2000);
    size_t quarter = 1;
    const auto aside = [&](const frond_vec3& p) { return p.x * force.x + p.z * force.z; };
    while (quarter + 1 < first.size() && aside(first[quarter]) > 0) quarter++;
    const double dt = 4e-3 * double(quarter) / 100;
    return main_period(plant.sway(bent, dt, 1000), dt);
}

// Returns the error that a plant built and stepped as advised makes.
double measured_error(const Kind& kind, const frond_advice& advice, const frond_vec3& force, double period) {
    const int steps = int(std::lround(2 * period / advice.time_step));
    const int finer = std::max(4, int(std::ceil(2000.0 / steps)));
    const auto path_of = [&](const frond_plant_def& def, double height, int divide) {
        const ModelPtr model = kind.build(height);
        Alone still(model, patient(def), kind.has_weight), plant(model, undamped(def), kind.has_weight);
        return plant.sway(still.bend(force), advice.time_step / divide, steps * divide, divide);
    };
    const Path exact = path_of(exact_rods(), kind.finest > 0 ? kind.finest : advice.capsule_height, finer);
    const Path path = path_of(advice.plant, advice.capsule_height, 1);
    double sum = 0;
    for (size_t i = 1; i < path.size(); i++) sum += std::pow(length(path[i] - exact[i]), 2);
    return std::sqrt(sum / steps) / length(exact.front());
}

void expect_kept(const Kind& kind, double first_height) {
    const ModelPtr model = kind.build(first_height);
    const frond_vec3 force = find_force(model, kind.has_weight);
    const double period = find_period(model, kind.has_weight, force);
    for (const double asked : {0.2, 0.05, 0.01, 0.002}) {
        frond_advice advice;
        ASSERT_EQ(frond_recommend(model->handle, asked, 0, &advice), FROND_OK) << frond_last_error();
        EXPECT_LE(advice.error, asked);
        const double error = measured_error(kind, advice, force, period);
        EXPECT_LE(error, 1.2 * advice.error)
            << "asked for " << asked << ": " << frond_integrator_name(advice.plant.integrator) << ", "
            << frond_mass_name(advice.plant.tuning.mass) << ", capsules of " << advice.capsule_height << " m, "
            << period / advice.time_step << " steps a period";
    }
}

ModelPtr build_stems(const std::vector<frond_stem>& stems, frond_rest rest, double capsule_height) {
    frond_organ_material organ = {"stem", frond_default_material()};
    organ.material.density = 1000;
    organ.material.young = 1.28e8;
    organ.material.poisson = 0.3;
    organ.material.hollow = 0;
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = rest;
    def.organs = &organ;
    def.organ_count = 1;
    def.capsule_height = capsule_height;
    frond_model model = {};
    must(frond_model_from_stems(stems.data(), int(stems.size()), &def, &model));
    return std::make_shared<const Model>(model);
}

Kind cone(double ratio) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, 1, 0}, 0.01, 0.01 / ratio};
    return {[=](double height) { return build_stems({stem}, FROND_REST_WITHOUT_GRAVITY, height); }, false, 1.0 / 200};
}

TEST(RecommendPlants, KeepsItsErrorOnACone5To1) {
    expect_kept(cone(5), 0.05);
}

TEST(RecommendPlants, KeepsItsErrorOnACone10To1) {
    expect_kept(cone(10), 0.05);
}

TEST(RecommendPlants, KeepsItsErrorOnAForkThatCarriesItsWeight) {
    const std::vector<frond_stem> stems = {{-1, {0, 0, 0}, {0, 0.6, 0}, 0.012, 0.008},
                                           {0, {0, 0.6, 0}, {0.15, 1.1, 0}, 0.007, 0.003},
                                           {0, {0, 0.6, 0}, {-0.1, 0.9, 0.1}, 0.006, 0.003},
                                           {0, {0, 0.4, 0}, {0.05, 0.6, -0.2}, 0.005, 0.002}};
    expect_kept({[=](double height) { return build_stems(stems, FROND_REST_STANDS_AS_MODELLED, height); }, true, 0.006},
                0.05);
}

// A mesh's chain is another plant with each length of its capsules, so that the reference has the same ones.
TEST(RecommendPlants, KeepsItsErrorOnACorn) {
    const auto build = [](double height) {
        frond_model_def def = frond_default_model_def();
        def.capsule_height = height;
        frond_model model = {};
        must(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &model));
        return std::make_shared<const frond::study::Model>(model);
    };
    expect_kept({build, true, 0}, 0);
}

}  // namespace recommend_plants_tests
