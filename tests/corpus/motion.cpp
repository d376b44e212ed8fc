// Motion of plants that nobody tuned to: at rest, in wind by rods and in a cage, and their first frequencies beside
// those that were measured of trees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "api/handles.hpp"
#include "calibration/sway_frequency.hpp"
#include "corpus.hpp"
#include "support/must.hpp"

namespace frond::test {
namespace motion_tests {

constexpr double H = 1.0 / 60;  // [s]

using Places = std::vector<frond_vec3>;

double gap(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// A plant of a file in still air, or in a steady wind of 5 m/s that is the same at each height.
struct Standing {
    frond_world world = {};
    frond_plant plant = {};
    Places modelled;
    std::vector<double> lengths;  // of the capsules, as modelled [m]
    double height = 0;            // [m]

    Standing(frond_model model, frond_mechanics mechanics, bool windy) {
        frond_world_def world_def = frond_default_world_def();
        world_def.sleep_distance = 0;
        must(frond_world_create(&world_def, &world));
        frond_wind_def wind = frond_default_wind_def();
        if (windy) wind.velocity = {5, 0, 0};
        wind.turbulence = 0;
        wind.profile = FROND_WIND_PROFILE_UNIFORM;
        must(frond_world_set_wind(world, &wind));
        frond_plant_def def = frond_default_plant_def();
        def.mechanics = mechanics;
        must(frond_plant_create(world, model, &def, &plant));
        frond_model_info info;
        must(frond_model_get_info(model, &info));
        height = info.upper.y - info.lower.y;
        modelled = places();
        lengths = measure();
    }
    ~Standing() { frond_world_destroy(world); }
    Standing(const Standing&) = delete;
    Standing& operator=(const Standing&) = delete;

    void step() { must(frond_world_step(world, H)); }
    Places places() const {
        frond_surface_view view;
        must(frond_plant_get_surface(plant, &view));
        Places out;
        for (int i = 0; i < view.vertex_count; i++)
            out.push_back({view.positions[3 * i], view.positions[3 * i + 1], view.positions[3 * i + 2]});
        return out;
    }
    std::vector<double> measure() const {
        std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
        must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
        std::vector<double> out;
        for (const frond_capsule& capsule : capsules) out.push_back(gap(capsule.begin, capsule.end));
        return out;
    }
    // Returns how far the drawn vertex that is farthest is from where it was modelled, over the height.
    double farthest() const {
        const Places now = places();
        double most = 0;
        for (size_t i = 0; i < now.size(); i++) most = std::max(most, gap(now[i], modelled[i]));
        return most / height;
    }
    double longest_segment() const {
        const std::vector<double> now = measure();
        double most = 1;
        for (size_t i = 0; i < now.size(); i++)
            if (lengths[i] > 0) most = std::max(most, now[i] / lengths[i]);
        return most;
    }
    // Returns the most by which a drawn edge is longer than it was modelled, of those that are not tiny.
    double longest_edge() const {
        constexpr double TINY = 0.01;  // share of the height
        frond_surface_view view;
        must(frond_plant_get_surface(plant, &view));
        const Places now = places();
        double most = 1;
        for (int t = 0; t < view.triangle_count; t++)
            for (int k = 0; k < 3; k++) {
                const size_t a = size_t(view.indices[3 * t + k]), b = size_t(view.indices[3 * t + (k + 1) % 3]);
                const double length = gap(modelled[a], modelled[b]);
                if (length > TINY * height) most = std::max(most, gap(now[a], now[b]) / length);
            }
        return most;
    }
};

struct InWind {
    double sway = 0, most = 0;     // over the height [-]; the first is the mean of the last two seconds
    double segment = 1, edge = 1;  // longest over its length as modelled [-]
};

InWind measure_in_wind(frond_model model, frond_mechanics mechanics) {
    constexpr int STEPS = 360, LAST = 120, OFTEN = 6;
    Standing standing(model, mechanics, true);
    InWind out;
    for (int step = 1; step <= STEPS; step++) {
        standing.step();
        out.segment = std::max(out.segment, standing.longest_segment());
        if (step % OFTEN != 0) continue;
        out.edge = std::max(out.edge, standing.longest_edge());
        const double moved = standing.farthest();
        out.most = std::max(out.most, moved);
        if (step > STEPS - LAST) out.sway += moved * OFTEN / LAST;
    }
    return out;
}

double measure_at_rest(frond_model model) {
    constexpr int STEPS = 120;
    double most = 0;
    for (const frond_mechanics mechanics : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL}) {
        Standing standing(model, mechanics, false);
        for (int step = 0; step < STEPS; step++) standing.step();
        most = std::max(most, standing.farthest());
    }
    return most;
}

// Returns the diameter of the thickest wood at a tenth of the height [m], where trees of 13 m have their breast height.
double trunk_of(const Model& model) {
    const double level = model.surface.lower().y() + 0.1 * model.surface.height();
    double most = 0;
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        if (node.parent < 0) continue;
        const double from = model.chain.nodes[size_t(node.parent)].position.y(), to = node.position.y();
        if (std::min(from, to) <= level && std::max(from, to) >= level) most = std::max(most, model.sections[i].width);
    }
    return most;
}

// Returns the frequency of a tree of that diameter and height [Hz], by Moore and Maguire 2004 (Trees 18, 195-203).
double measured_frequency(double diameter, double height) {
    return 0.0948 + 3.4317 * 100 * diameter / (height * height);
}

bool is_tree(const Row& row) {
    return row.counts[CROWNS][0] > 0 && row.counts[STEMS][0] == 1;
}

// Shares of files for which something holds.
struct Share {
    const char* what;
    double asked;  // least of it [-]
    int right = 0, all = 0;
    const char* add(bool holds, const char* sign) {
        right += holds;
        all++;
        return holds ? "" : sign;
    }
};

TEST(Motion, IsThatOfPlants) {
    // What is asked of every file holds for this share of them so far.
    Share rest = {"at rest within 1 % of the height", 1}, segment = {"segments no longer than 1.02", 1},
          edge = {"edges no longer than 1.3", 0.9}, moves = {"moves in wind", 0.7},
          agree = {"rods and cage within a factor of 2", 0.65}, frequency = {"frequency within a factor of 2", 0.4};
    std::printf("%-28s rest     rods     cage     segment edges       f, of    trees\n", "");
    for (const Row& row : read_seen()) {
        if (!is_wanted(row)) continue;
        frond_model_def def = frond_default_model_def();
        def.allow_stiffening = INFINITY;
        frond_model model = {};
        must(frond_model_load(path_of(row).c_str(), &def, &model));
        const double still = measure_at_rest(model);
        const InWind rods = measure_in_wind(model, FROND_MECHANICS_ROD),
                     cage = measure_in_wind(model, FROND_MECHANICS_TET_COROTATIONAL);
        const auto inside = frond::get(model);
        const double f = sway_frequency(inside),
                     measured = measured_frequency(trunk_of(*inside), inside->surface.height());
        const double ratio = rods.sway / cage.sway;
        std::printf("%-28s %-8.2g %-8.2g %-8.2g %-7.3f %-5.2f %-5.2f %-5.2f %-8.3g", row.file.c_str(), still, rods.sway,
                    cage.sway, rods.segment, rods.edge, cage.edge, f, is_tree(row) ? measured : 0);
        std::string marks = rest.add(still < 0.01, "R");
        marks += segment.add(rods.segment < 1.02, "S");
        marks += edge.add(std::max(rods.edge, cage.edge) < 1.3, "E");
        marks += moves.add(std::max(rods.most, cage.most) > 1e-3, "M");
        marks += agree.add(ratio < 2 && ratio > 0.5, "C");
        if (is_tree(row)) marks += frequency.add(f < 2 * measured && f > measured / 2, "F");
        std::printf(" %s\n", marks.c_str());
        std::fflush(stdout);
        frond_model_destroy(model);
    }
    for (const Share& share : {rest, segment, edge, moves, agree, frequency}) {
        std::printf("%s: %d of %d\n", share.what, share.right, share.all);
        EXPECT_GE(share.right, share.asked * share.all) << share.what;
    }
}

}  // namespace motion_tests
}  // namespace frond::test
