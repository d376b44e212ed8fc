// In: a plant that stands and a thing that comes at it. Out: whether core lines of the one went through those of the
// other, counted over all steps, so that what is put back has not passed.
#include "stability/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "stability/bench.hpp"
#include "stability/crossing.hpp"

namespace frond::stability {

namespace {

// Displacement in a step from which on kinematic bodies are known to pass, and to say so [m].
constexpr double KNOWN = 0.2;
// A plant of 1 m whose middle is met, from before it to behind it, and how long all is watched from there [m], [s].
constexpr double TALL = 1, MEETS_AT = 0.487, BEFORE = 0.05, BEHIND = 0.2;
constexpr double THIN = 0.005, LEAF_HALF_WIDTH = 0.03;
const double SQUARE_ROOT = std::sqrt(0.5);

// Returns the def of an upright model in metres, of one kind of organ, whose stiffness it sets; `organ` is to outlive
// it.
frond_model_def stiff_def(const char* kind, frond_organ_material& organ) {
    organ.organ = kind;
    must(frond_material_preset(kind, &organ.material));
    organ.material.young = 1e9;
    frond_model_def def = frond_default_model_def();
    def.organs = &organ;
    def.organ_count = 1;
    def.scale = 1;
    def.up = {0, 1, 0};
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    return def;
}

frond_model model_of_stems(const frond_stem* stems, int count) {
    frond_organ_material organ = {};
    const frond_model_def def = stiff_def("stem", organ);
    frond_model model = {};
    must(frond_model_from_stems(stems, count, &def, &model));
    return model;
}

// A blade 1 m long and 6 cm wide that faces x: its vertices are in rows of WIDE + 1 along it.
constexpr int LONG = 20, WIDE = 4;
frond_model leaf_model() {
    std::vector<float> xyz;
    std::vector<int32_t> indices;
    for (int i = 0; i <= LONG; i++)
        for (int k = 0; k <= WIDE; k++)
            for (const double value : {0.0, TALL * i / LONG, LEAF_HALF_WIDTH * (2.0 * k / WIDE - 1)})
                xyz.push_back(float(value));
    for (int i = 0; i < LONG; i++)
        for (int k = 0; k < WIDE; k++) {
            const int a = i * (WIDE + 1) + k, b = a + WIDE + 1;
            indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    frond_organ_material blade = {};
    const frond_model_def def = stiff_def("blade", blade);
    blade.material.thickness = 2e-3;
    frond_model model = {};
    must(frond_model_from_triangles(xyz.data(), int(xyz.size() / 3), indices.data(), int(indices.size() / 3), &def,
                                    &model));
    return model;
}

// The world of a sweep: what stands at the origin, and what comes.
struct Range {
    const Sweep sweep;
    Bench bench;
    std::function<Core()> standing, coming;
    std::function<void(double x)> carry;  // empty: it flies
    double start;                         // of what comes [m]

    explicit Range(const Sweep& of) : sweep(of), bench({of.mechanics, FROND_INTEGRATOR_BDF2, of.dt}) {
        // It meets the plant somewhere within a step.
        start = -BEFORE - 0.63 * of.speed * of.dt;
        bench.world_def.gravity = {0, 0, 0};
        bench.box = 1e4;
    }
    frond_vec3 place(double x) const { return {x, MEETS_AT, 0}; }
};

Core capsules_of(frond_plant plant) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
    Core core;
    for (const frond_capsule& c : capsules) core.push_back({c.begin, c.end});
    return core;
}

// Lines along a leaf, inside of its rims, and their vertices by the places that they had when it was made.
std::function<Core()> lines_of(frond_plant plant, const std::vector<frond_vec3>& modelled) {
    frond_surface_view view = {};
    must(frond_plant_get_surface(plant, &view));
    const auto place = [](const frond_surface_view& of, int vertex) {
        return frond_vec3{of.positions[3 * vertex], of.positions[3 * vertex + 1], of.positions[3 * vertex + 2]};
    };
    std::vector<int> vertices;
    for (const frond_vec3& p : modelled) {
        int nearest = 0;
        for (int v = 1; v < view.vertex_count; v++)
            if (length(place(view, v) - p) < length(place(view, nearest) - p)) nearest = v;
        vertices.push_back(nearest);
    }
    return [=] {
        frond_surface_view now = {};
        must(frond_plant_get_surface(plant, &now));
        Core core;
        for (int k = 1; k < WIDE; k++)
            for (int i = 0; i < LONG; i++)
                core.push_back({place(now, vertices[size_t(i * (WIDE + 1) + k)]),
                                place(now, vertices[size_t((i + 1) * (WIDE + 1) + k)])});
        return core;
    };
}

std::vector<frond_vec3> leaf_places(const std::function<frond_vec3(const frond_vec3&)>& put) {
    std::vector<frond_vec3> places;
    for (int i = 0; i <= LONG; i++)
        for (int k = 0; k <= WIDE; k++)
            places.push_back(put({0, TALL * i / LONG, LEAF_HALF_WIDTH * (2.0 * k / WIDE - 1)}));
    return places;
}

// Adds a plant that lies along z through the middle of the one that stands, and is carried by its foot.
frond_plant add_carried(Range& range, frond_model model) {
    constexpr double FOOT_HEIGHT = 0.03;
    range.bench.plant_def.rotation = {SQUARE_ROOT, 0, 0, SQUARE_ROOT};
    range.bench.plant_def.root_height = -1;
    const frond_vec3 at = range.place(range.start) + frond_vec3{0, 0, -MEETS_AT};
    const frond_plant plant = range.bench.add(model, at);
    const std::vector<int> foot = range.bench.hold(plant, FOOT_HEIGHT);
    range.carry = [&range, plant, foot](double x) {
        range.bench.move(plant, foot, [&](const frond_vec3& p) { return p + frond_vec3{x - range.start, 0, 0}; });
    };
    return plant;
}

void add_stems(Range& range) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, TALL, 0}, THIN, THIN};
    const frond_model model = range.bench.keep(model_of_stems(&stem, 1));
    const frond_plant first = range.bench.add(model), second = add_carried(range, model);
    range.standing = [first] { return capsules_of(first); };
    range.coming = [second] { return capsules_of(second); };
}

void add_leaves(Range& range) {
    const frond_model model = range.bench.keep(leaf_model());
    const frond_plant first = range.bench.add(model), second = add_carried(range, model);
    range.standing = lines_of(first, leaf_places([](const frond_vec3& p) { return p; }));
    range.coming = lines_of(second, leaf_places([&](const frond_vec3& p) {
                                return range.place(range.start) + frond_vec3{p.x, -p.z, p.y - MEETS_AT};
                            }));
}

// One plant of two stems: the second is carried by its own foot.
void add_itself(Range& range) {
    const frond_vec3 foot = range.place(range.start) - frond_vec3{0, 0, MEETS_AT};
    const frond_stem stems[] = {{-1, {0, 0, 0}, {0, TALL, 0}, THIN, THIN},
                                {-1, foot, foot + frond_vec3{0, 0, TALL}, THIN, THIN}};
    const frond_model model = range.bench.keep(model_of_stems(stems, 2));
    range.bench.plant_def.effects |= FROND_EFFECT_SELF_CONTACT;
    range.bench.plant_def.root_height = 0.03;
    const frond_plant plant = range.bench.add(model);
    const Places places = range.bench.places(plant);
    std::vector<int> held;
    for (size_t n = 0; n < places.size(); n++)
        if (places[n].y > 0.25 && std::abs(places[n].x - foot.x) < 0.04 && places[n].z < foot.z + 0.03) {
            held.push_back(int(n));
            must(frond_plant_pin(plant, int(n)));
        }
    range.carry = [&range, plant, held](double x) {
        range.bench.move(plant, held, [&](const frond_vec3& p) { return p + frond_vec3{x - range.start, 0, 0}; });
    };
    const auto half = [plant](bool second) {
        Core half;
        const Core all = capsules_of(plant);
        for (size_t i = 0; i < all.size(); i++)
            if ((i >= all.size() / 2) == second) half.push_back(all[i]);
        return half;
    };
    range.standing = [half] { return half(false); };
    range.coming = [half] { return half(true); };
}

// Adds a stem and a body whose core is level lines across the stem, at these heights from its middle.
void add_body(Range& range, frond_rigid_def def, double half_length, const std::vector<double>& heights) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, TALL, 0}, THIN, THIN};
    const frond_plant plant = range.bench.add(range.bench.keep(model_of_stems(&stem, 1)));
    def.state.position = range.place(range.start);
    if (def.mass > 0) def.state.velocity = {range.sweep.speed, 0, 0};
    const frond_rigid rigid = range.bench.add(def);
    range.standing = [plant] { return capsules_of(plant); };
    range.coming = [=] {
        frond_rigid_state state = {};
        must(frond_rigid_get_state(rigid, &state));
        Core core;
        for (const double y : heights)
            core.push_back(
                {state.position + frond_vec3{0, y, -half_length}, state.position + frond_vec3{0, y, half_length}});
        return core;
    };
    if (def.mass > 0) return;
    range.carry = [&range, rigid, def](double x) {
        frond_rigid_state state = def.state;
        state.position = range.place(x);
        must(frond_rigid_set_state(rigid, &state));
    };
}

void add_box(Range& range, double half_thickness) {
    const double half_height = 0.1, half_width = 0.5;
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_BOX;
    def.size = {half_thickness, half_height, half_width};
    def.mass = 0;
    std::vector<double> heights;
    for (double y = -0.9 * half_height; y < half_height; y += 0.1 * half_height) heights.push_back(y);
    add_body(range, def, half_width, heights);
}

void add_ball(Range& range) {
    constexpr double RADIUS = 0.025, INSIDE = 0.8;
    frond_rigid_def def = frond_default_rigid_def();
    def.size = {RADIUS, 0, 0};
    def.mass = 0.065;
    add_body(range, def, INSIDE * RADIUS, {0});
}

void add_wire(Range& range) {
    constexpr double RADIUS = 0.001, HALF_LENGTH = 0.5;
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = FROND_SHAPE_CAPSULE;
    def.size = {RADIUS, HALF_LENGTH, 0};
    def.state.rotation = {SQUARE_ROOT, 0, 0, SQUARE_ROOT};
    def.mass = 0;
    add_body(range, def, HALF_LENGTH, {0});
}

struct MeetingRow {
    const char* name;
    void (*add)(Range&);
};
const MeetingRow& row_of(Meeting meeting) {
    static const MeetingRow TABLE[] = {
        {"stem through stem", add_stems},
        {"stem through its own", add_itself},
        {"leaf through leaf", add_leaves},
        {"wall of 4 cm", [](Range& range) { add_box(range, 0.02); }},
        {"ball of 5 cm", add_ball},
        {"wire of 2 mm", add_wire},
        {"plate of 2 mm", [](Range& range) { add_box(range, 0.001); }},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == size_t(Meeting::COUNT), "every meeting needs its row");
    return TABLE[size_t(meeting)];
}

// Runs until what comes has gone its way, and a while longer; returns the crossings. A free body has moved by the time
// a plant steps, so where it is then the plant is where it was before.
int run(Range& range) {
    const Sweep& sweep = range.sweep;
    const double way = BEHIND - range.start, after = 0.25;
    const int coming = int(std::ceil(way / (sweep.speed * sweep.dt))),
              steps = coming + int(std::ceil(after / sweep.dt));
    int count = 0;
    range.bench.step(sweep.dt);  // Bullet takes a new kinematic body for one that has come from elsewhere
    Core standing = range.standing(), came = range.coming();
    const double from = came.front()[0].x;
    Core stood = standing;  // before the step
    for (int i = 1; i <= steps; i++) {
        if (range.carry) range.carry(range.start + sweep.speed * sweep.dt * std::min(i, coming));
        range.bench.step(sweep.dt);
        const Core stands = range.standing(), standing_now = range.carry ? stands : stood, came_now = range.coming();
        count += crossings(standing, standing_now, came, came_now);
        stood = stands;
        standing = standing_now;
        came = came_now;
    }
    if (count == 0 && sweep.meeting != Meeting::BALL) {
        // What is carried by its foot has come by its foot at least.
        const double came_by = came.front()[0].x - from;
        range.bench.expect(came_by > 0.9 * way, "came by [m]", came_by, 0.9 * way);
    }
    return count;
}

}  // namespace

const char* name_of(Meeting meeting) {
    return row_of(meeting).name;
}

bool may_pass(const Sweep& sweep) {
    return sweep.meeting != Meeting::BALL && sweep.speed * sweep.dt > 0.5 * TALL;
}

bool is_known_to_pass(const Sweep& sweep) {
    const double way = sweep.speed * sweep.dt;
    switch (sweep.meeting) {
        case Meeting::WALL:
        case Meeting::WIRE:
        case Meeting::PLATE:
            return way > KNOWN;
        default:
            return false;
    }
}

Verdict run_sweep(const Sweep& sweep) {
    uint32_t trouble = 0;
    Verdict verdict = verdict_of([&] {
        Range range(sweep);
        row_of(sweep.meeting).add(range);
        const int count = run(range);
        trouble = range.bench.trouble;
        if (count == 0) return;
        if (may_pass(sweep) && trouble & FROND_TROUBLE_PASSED) throw DoesNotApply("passes, as it may");
        throw Broken(trouble & FROND_TROUBLE_PASSED ? "passes" : "passes in silence");
    });
    verdict.trouble = trouble;
    return verdict;
}

}  // namespace frond::stability
