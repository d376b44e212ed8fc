// The figure "contact". In: settings of contact. Out: the depth over time of two corn plants that were made
// overlapping, and the cost of a step. Depth is the deepest contact that the plants report; it agrees with what FCL
// finds between their cages (tests/collide/cage_contact.cpp, tests/world/plants.cpp).
#include <algorithm>
#include <cmath>

#include "study/figures.hpp"

namespace frond::study {
namespace {

struct Case {
    const char* caption;
    std::vector<std::string> assignments;
    Effort from;            // least effort with which it is run
    bool is_motion = true;  // it changes their motion; false: only its cost
};

const std::vector<Case>& cases() {
    static const std::vector<Case> list = {
        {"baseline", {}, Effort::TINY},
        {"response penalty", {"response=penalty"}, Effort::QUICK},
        {"response none", {"response=none"}, Effort::TINY},
        {"step 1/30 s", {"dt=0.0333333333", "max_substep=0.0333333333"}, Effort::QUICK},
        {"step 1/120 s", {"dt=0.0083333333"}, Effort::FULL},
        {"step 1/240 s", {"dt=0.0041666667"}, Effort::FULL},
        {"organs collide", {"collision=organs"}, Effort::QUICK},
        {"rods", {"mechanics=rod"}, Effort::QUICK},
        {"neo-Hookean tets", {"mechanics=tet_neohookean"}, Effort::FULL},
        {"h = 10 cm", {"capsule_height=0.1"}, Effort::QUICK},
        {"h = 20 cm", {"capsule_height=0.2"}, Effort::FULL},
        {"h = 40 cm", {"capsule_height=0.4"}, Effort::FULL},
        {"r = 1 cm", {"capsule_radius=0.01"}, Effort::FULL},
        {"r = 5 cm", {"capsule_radius=0.05"}, Effort::QUICK},
        {"cage's cells 12 cm", {"cage_size=0.12"}, Effort::FULL},
        {"grid, cell 10 cm", {"hash_cell_size=0.1"}, Effort::FULL, false},
        {"grid, cell 50 cm", {"hash_cell_size=0.5"}, Effort::FULL, false},
        {"paper's hash, n = 199", {"hash_layout=paper", "hash_table_size=199"}, Effort::TINY, false},
        {"paper's hash, n = 1999", {"hash_layout=paper", "hash_table_size=1999"}, Effort::FULL, false},
        {"paper's hash, n = 9973", {"hash_layout=paper", "hash_table_size=9973"}, Effort::FULL, false},
        {"paper's hash, n = 9973, cell 10 cm",
         {"hash_layout=paper", "hash_table_size=9973", "hash_cell_size=0.1"},
         Effort::QUICK,
         false},
        {"paper's hash, n = 9973, cell 50 cm",
         {"hash_layout=paper", "hash_table_size=9973", "hash_cell_size=0.5"},
         Effort::FULL,
         false},
        {"every pair", {"hash_layout=brute_force"}, Effort::FULL, false},
    };
    return list;
}

FigurePanel come_apart(const Case& one) {
    constexpr double DURATION = 2, CLEAR = 0.001, LEAST = 1e-5;  // [s]; apart, drawn as zero [m]
    const tools::Casting casting = tools::cast("corn_pair");
    std::vector<std::string> assignments = {"collision=cage", "sleep_distance=0"};
    assignments.insert(assignments.end(), one.assignments.begin(), one.assignments.end());
    tools::Play play(casting, tools::settings_of(casting, assignments));
    FigurePanel panel;
    panel.caption = panel.curve.name = one.caption;
    double first = 0, depth = 0, clear_since = 0, search = 0, response = 0;
    int steps = 0;
    while (play.stage.time < DURATION - 0.5 * play.stage.settings.dt) {
        play.step();
        depth = tools::contact_depth(play.stage.plants[0]);
        if (steps++ == 0) first = depth;
        if (depth > CLEAR) clear_since = play.stage.time;
        frond_profile profile;
        must(frond_world_get_profile(play.stage.world, &profile));
        search += profile.ms_collide;
        response += profile.ms_response;
        panel.curve.x.push_back(play.stage.time);
        panel.curve.y.push_back(1e3 * std::max(depth, LEAST));
    }
    panel.row = {1e3 * first, 1e3 * depth, clear_since, search / steps, response / steps};
    if (!one.is_motion) panel.curve = {};
    return panel;
}

}  // namespace

Figure make_contact(const std::string&, Effort effort) {
    Figure figure = {
        "contact",
        "two corn plants, made with their leaves in each other, come apart by their cages; the baseline, then one "
        "setting changed at a time. Settings of the hash change only what it costs, so they have no curve",
        "time [s]",
        "deepest contact [mm]",
        "y",
        {"setting", "deepest at first [mm]", "left after 2 s [mm]", "last above 1 mm at [s]", "search [ms a step]",
         "response [ms a step]"},
        {}};
    for (const Case& one : cases())
        if (one.from <= effort) figure.panels.push_back(come_apart(one));
    return figure;
}

}  // namespace frond::study
