// Plants of one model in a world, through the C API, with their boundaries for the referee, among them the corn pair of
// the paper's figure 5.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "support/lengths.hpp"
#include "support/must.hpp"
#include "support/referee.hpp"
#include "support/stems.hpp"

namespace frond::test {

constexpr double H = 1.0 / 60;

// Returns the def of a world without gravity in which nothing sleeps and a step of that length is not divided.
inline frond_world_def weightless(double step) {
    frond_world_def def = frond_default_world_def();
    def.gravity = {0, 0, 0};
    def.max_substep = std::max(def.max_substep, step);
    def.sleep_distance = 0;
    return def;
}

struct Stand {
    frond_world world = {};
    frond_model model = {};
    std::vector<frond_plant> plants;
    double h = H;  // [s]

    explicit Stand(const frond_world_def& def = frond_default_world_def()) { must(frond_world_create(&def, &world)); }
    Stand(const Stand&) = delete;
    Stand& operator=(const Stand&) = delete;
    ~Stand() {
        frond_world_destroy(world);
        frond_model_destroy(model);
    }
    void load_corn() {
        frond_model_def def = frond_default_model_def();
        must(frond_model_load(FROND_SOURCE_DIR "/models/corn/corn.obj", &def, &model));
    }
    void make_stems(const std::vector<frond_stem>& stems, double young = 1e8) {
        frond_material material = {};
        must(frond_material_preset("stem", &material));
        material.young = young;
        material.damping_ratio = 0;
        model = make_stems_of(stems.data(), int(stems.size()), &material, FROND_REST_WITHOUT_GRAVITY);
    }
    frond_plant_def plant_def() const { return frond_default_plant_def(); }
    frond_plant add(frond_plant_def def, const frond_vec3& place, double turn = 0) {
        def.position = place;
        def.rotation = {0, std::sin(turn / 2), 0, std::cos(turn / 2)};
        frond_plant plant = {};
        must(frond_plant_create(world, model, &def, &plant));
        plants.push_back(plant);
        return plant;
    }
    void steps(int count) {
        for (int i = 0; i < count; i++) must(frond_world_step(world, h));
    }
    frond_report report() const {
        frond_report report = {};
        must(frond_world_get_report(world, &report));
        return report;
    }
    uint64_t hash() const {
        uint64_t hash = 0;
        must(frond_world_get_state_hash(world, &hash));
        return hash;
    }
    std::vector<double> places(frond_plant plant) const {
        const int count = frond_plant_get_node_count(plant);
        std::vector<double> places(3 * size_t(count));
        must(frond_plant_get_state(plant, places.data(), nullptr, count));
        return places;
    }
    void throw_plant(frond_plant plant, const frond_vec3& velocity) {
        const int count = frond_plant_get_node_count(plant);
        std::vector<double> v;
        for (int i = 0; i < count; i++) v.insert(v.end(), {velocity.x, velocity.y, velocity.z});
        must(frond_plant_set_state(plant, nullptr, v.data(), count));
    }
    // Returns the boundary of the cage as it is now.
    TriangleMesh cage(frond_plant plant) const {
        frond_cage_view view = {};
        must(frond_model_get_cage(model, &view));
        constexpr int FACES[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        std::map<std::array<int, 3>, std::pair<Triangle, int>> faces;
        for (int t = 0; t < view.tet_count; t++)
            for (const auto& f : FACES) {
                const Triangle face = {view.tets[4 * t + f[0]], view.tets[4 * t + f[1]], view.tets[4 * t + f[2]]};
                std::array<int, 3> key = face;
                std::sort(key.begin(), key.end());
                auto& [kept, count] = faces[key];
                kept = face;
                count++;
            }
        TriangleMesh mesh;
        const std::vector<double> x = places(plant);
        for (size_t i = 0; i < x.size(); i += 3) mesh.points.emplace_back(x[i], x[i + 1], x[i + 2]);
        for (const auto& [key, face] : faces)
            if (face.second == 1) mesh.triangles.push_back(face.first);
        return mesh;
    }
    TriangleMesh surface(frond_plant plant) const {
        frond_surface_view view = {};
        must(frond_plant_get_surface(plant, &view));
        TriangleMesh mesh;
        for (int i = 0; i < view.vertex_count; i++)
            mesh.points.emplace_back(view.positions[3 * i], view.positions[3 * i + 1], view.positions[3 * i + 2]);
        for (int i = 0; i < view.triangle_count; i++)
            mesh.triangles.push_back({view.indices[3 * i], view.indices[3 * i + 1], view.indices[3 * i + 2]});
        return mesh;
    }
};

// Position of the second of two plants relative to the first [m], and rotations of both about their vertical axes
// [rad].
struct Placement {
    frond_vec3 place;
    std::array<double, 2> turns;
};
// The plants of the scene corn_pair, and of examples/pair.c.
constexpr Placement AS_IN_SCENE = {{0.9, 0, 0.03}, {0.1, -0.05}}, AS_IN_EXAMPLE = {{0.9, 0, 0.03}, {0, 0}};

struct CornPair : Stand {
    explicit CornPair(frond_response response, frond_mechanics mechanics = FROND_MECHANICS_TET_COROTATIONAL,
                      double step = H, const Placement& placement = AS_IN_SCENE,
                      frond_collision collision = FROND_COLLISION_CAGE)
        : Stand(def_of(response, step)) {
        h = step;
        load_corn();
        frond_plant_def def = plant_def();
        def.mechanics = mechanics;
        def.collision = collision;
        const frond_vec3& at = placement.place;
        add(def, {-0.45, 0, 0}, placement.turns[0]);
        add(def, {at.x - 0.45, at.y, at.z}, placement.turns[1]);
    }
    static frond_world_def def_of(frond_response response, double step) {
        frond_world_def def = frond_default_world_def();
        def.max_substep = std::max(def.max_substep, step);
        def.response = response;
        def.sleep_distance = 0;  // no sleep, in which plants would stand still
        return def;
    }
    double cage_depth() const { return deepest_overlap(cage(plants[0]), cage(plants[1])).depth; }
    double surface_depth() const { return deepest_overlap(surface(plants[0]), surface(plants[1])).depth; }
    // Returns the depth that the plants report.
    double contact_depth() const {
        std::vector<frond_contact> contacts(size_t(frond_plant_get_contact_count(plants[0])));
        must(frond_plant_get_contacts(plants[0], contacts.data(), int(contacts.size())));
        double depth = 0;
        for (const frond_contact& contact : contacts) depth = std::max(depth, -contact.gap);
        return depth;
    }
};

}  // namespace frond::test
