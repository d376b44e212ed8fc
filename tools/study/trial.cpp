#include "study/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "scenes/vector.hpp"
#include "study/known.hpp"

namespace frond::study {
namespace {

using tools::cross;
using tools::dot;
using tools::operator-;

// Solves a symmetric 3x3 system by Cramer's rule; rows are vectors.
frond_vec3 solve(const std::array<frond_vec3, 3>& rows, const frond_vec3& right) {
    const frond_vec3 a = {rows[0].x, rows[1].x, rows[2].x}, b = {rows[0].y, rows[1].y, rows[2].y},
                     c = {rows[0].z, rows[1].z, rows[2].z};
    const double determinant = dot(a, cross(b, c));
    return {dot(right, cross(b, c)) / determinant, dot(a, cross(right, c)) / determinant,
            dot(a, cross(b, right)) / determinant};
}

}  // namespace

double cpu_now() {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

Trial::Trial(ModelPtr given, const Setup& given_setup) : model(std::move(given)), setup(given_setup) {
    frond_world_def def = frond_default_world_def();
    def.gravity = {0, 0, 0};
    def.max_substep = 1;
    def.sleep_distance = 0;
    must(frond_world_create(&def, &world));
    const frond_result made = frond_plant_create(world, model->handle, &setup.plant, &plant);
    if (made != FROND_OK) frond_world_destroy(world);
    must(made);
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    rest_surface.assign(view.positions, view.positions + 3 * view.vertex_count);
    rest_nodes = state().x;
}

Trial::~Trial() {
    frond_world_destroy(world);
}

const std::vector<int>& Trial::section(double height) {
    std::vector<int>& list = sections[std::lround(height * 1e6)];
    if (list.empty())
        for (size_t i = 0; i < rest_surface.size() / 3; i++)
            if (std::abs(double(rest_surface[3 * i + 1]) - height) < 1e-5) list.push_back(int(i));
    if (list.empty()) throw SceneError("the beam has no section at " + std::to_string(height) + " m");
    return list;
}

frond_vec3 Trial::middle(double height) {
    const std::vector<int>& list = section(height);
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    frond_vec3 sum = {0, 0, 0};
    for (int i : list) {
        const float* p = view.positions + 3 * i;
        sum = {sum.x + p[0], sum.y + p[1], sum.z + p[2]};
    }
    const double n = double(list.size());
    return {sum.x / n, sum.y / n, sum.z / n};
}

double Trial::twist(double height) {
    const frond_vec3 now = middle(height);
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    double sine = 0, cosine = 0;
    for (int i : section(height)) {
        const float *p = view.positions + 3 * i, *r = rest_surface.data() + 3 * i;
        // Angle about +y from the section at rest, whose middle is on the axis.
        const double x = p[0] - now.x, z = p[2] - now.z, rx = r[0], rz = r[2];
        sine += rz * x - rx * z;
        cosine += rx * x + rz * z;
    }
    return std::atan2(sine, cosine);
}

std::vector<double> Trial::section_heights(double length) const {
    std::vector<double> heights;
    for (size_t i = 0; i < rest_surface.size() / 3; i++) {
        const double y = double(rest_surface[3 * i + 1]);
        if (y > -1e-5 && y < length + 1e-5) heights.push_back(y);
    }
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 1e-5; }),
                  heights.end());
    return heights;
}

void Trial::set_gravity(frond_vec3 gravity) {
    must(frond_world_set_gravity(world, gravity));
}

// Returns the highest layer of cage nodes, at least four of them.
const std::vector<int>& Trial::end_nodes() {
    if (!ends.empty()) return ends;
    const size_t count = rest_nodes.size() / 3;
    double top = -1e30, low = 1e30;
    for (size_t i = 0; i < count; i++) {
        top = std::max(top, rest_nodes[3 * i + 1]);
        low = std::min(low, rest_nodes[3 * i + 1]);
    }
    for (double depth = 1e-6 * (top - low); ends.size() < 4; depth *= 2) {
        ends.clear();
        for (size_t i = 0; i < count; i++)
            if (rest_nodes[3 * i + 1] > top - depth) ends.push_back(int(i));
    }
    return ends;
}

// Splits the force equally, and the moment into forces perpendicular to their lever arms.
void Trial::push_end(frond_vec3 force, frond_vec3 moment) {
    const std::vector<int>& nodes = end_nodes();
    const std::vector<double> x = state().x;
    const double n = double(nodes.size());
    const auto at = [&](int i) { return frond_vec3{x[size_t(3 * i)], x[size_t(3 * i + 1)], x[size_t(3 * i + 2)]}; };
    frond_vec3 centre = {0, 0, 0};
    for (int i : nodes) centre = {centre.x + at(i).x / n, centre.y + at(i).y / n, centre.z + at(i).z / n};
    const frond_vec3 shift = cross(middle(Beam::LENGTH) - centre, force);
    moment = {moment.x + shift.x, moment.y + shift.y, moment.z + shift.z};
    std::array<frond_vec3, 3> J = {};
    for (int i : nodes) {
        const frond_vec3 d = at(i) - centre;
        const double r2 = dot(d, d);
        J[0] = J[0] - frond_vec3{d.x * d.x - r2, d.x * d.y, d.x * d.z};
        J[1] = J[1] - frond_vec3{d.y * d.x, d.y * d.y - r2, d.y * d.z};
        J[2] = J[2] - frond_vec3{d.z * d.x, d.z * d.y, d.z * d.z - r2};
    }
    const frond_vec3 turn = solve(J, moment);
    for (int i : nodes) {
        const frond_vec3 f = cross(turn, at(i) - centre);
        must(frond_plant_add_force(plant, i, {f.x + force.x / n, f.y + force.y / n, f.z + force.z / n}));
    }
}

// Distributes the load over the layers of cage nodes.
void Trial::push_along(double length, const std::function<double(double)>& density) {
    const size_t count = rest_nodes.size() / 3;
    constexpr int SLICES = 400;
    std::vector<std::pair<double, int>> order;
    for (size_t i = 0; i < count; i++) order.push_back({rest_nodes[3 * i + 1], int(i)});
    std::sort(order.begin(), order.end());
    std::vector<double> force(count, 0);
    for (int k = 0; k < SLICES; k++) {
        // The load of a slice is split between the layers of nodes below and above it by the lever rule.
        const double y = (k + 0.5) * length / SLICES, load = density(y) * length / SLICES;
        const auto above = std::lower_bound(order.begin(), order.end(), std::make_pair(y, -1));
        const double high = above == order.end() ? order.back().first : above->first;
        const double low = above == order.begin() ? order.front().first : std::prev(above)->first;
        const double share = high > low ? (y - low) / (high - low) : 1;
        for (const auto& [level, part] : {std::make_pair(low, 1 - share), std::make_pair(high, share)}) {
            const auto first = std::lower_bound(order.begin(), order.end(), std::make_pair(level - 1e-6 * length, -1));
            const auto last = std::lower_bound(first, order.end(), std::make_pair(level + 1e-6 * length, -1));
            for (auto node = first; node != last; ++node)
                force[size_t(node->second)] += part * load / double(last - first);
        }
    }
    for (size_t i = 0; i < count; i++)
        if (force[i] != 0) must(frond_plant_add_force(plant, int(i), {force[i], 0, 0}));
}

void Trial::step(double dt) {
    const double start = cpu_now();
    must(frond_world_step(world, dt));
    cpu += cpu_now() - start;
    frond_report report;
    must(frond_world_get_report(world, &report));
    trouble |= report.trouble;
}

Trial::State Trial::state() const {
    const int count = frond_plant_get_node_count(plant);
    State state;
    state.x.resize(size_t(3 * count));
    state.v.resize(size_t(3 * count));
    must(frond_plant_get_state(plant, state.x.data(), state.v.data(), count));
    return state;
}

void Trial::set_state(const State& state) {
    must(frond_plant_set_state(plant, state.x.data(), state.v.data(), int(state.x.size() / 3)));
}

void Trial::start_from(const Trial& rests) {
    State start = rests.state();
    std::fill(start.v.begin(), start.v.end(), 0.0);
    set_state(start);
}

static double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

// Returns null if the library had to rewind the plant on the way.
static std::unique_ptr<Trial> try_to_settle(const ModelPtr& model, const Setup& setup, int ramp, double step,
                                            int most_steps, const LoadFunction& load) {
    constexpr double AT_REST = 1e-7;  // largest motion per step [m]
    auto trial = std::make_unique<Trial>(model, setup);
    std::vector<double> before = trial->state().x;
    for (int i = 1; i <= most_steps; i++) {
        load(*trial, std::min(1.0, double(i) / ramp));
        trial->step(step);
        if (trial->trouble & FROND_TROUBLE_REWOUND) return nullptr;
        const std::vector<double> now = trial->state().x;
        if (i > ramp && farthest(now, before) < AT_REST) break;
        before = now;
    }
    return trial;
}

std::unique_ptr<Trial> settle(const ModelPtr& model, const Setup& setup, int ramp, const LoadFunction& load,
                              int most_steps) {
    Setup patient = setup;
    patient.plant.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    patient.plant.tuning.newton_tolerance = 1e-9;
    patient.plant.mass_damping = patient.plant.stiffness_damping = patient.plant.material_damping = 0;
    // Converged steps find most shapes; single solves, which re-evaluate follower loads in each step, find the others.
    // If both overshoot, shorter steps succeed, in which implicit Euler damps vibration within seconds. A search for a
    // step may lead to another shape: one that needed none is better.
    std::unique_ptr<Trial> searched;
    for (double step : {1.0, 0.1})
        for (int solves : {10, 1}) {
            patient.plant.tuning.newton_iterations = solves;
            const int raised = int(std::lround(ramp / std::sqrt(step)));
            std::unique_ptr<Trial> trial = try_to_settle(model, patient, raised, step, most_steps, load);
            if (!trial) continue;
            if (!(trial->trouble & FROND_TROUBLE_RETRIED)) return trial;
            if (!searched) searched = std::move(trial);
        }
    if (!searched) throw SceneError("no shape at rest was found");
    return searched;
}

double time_steps(Trial& trial, Effort effort, const LoadFunction& load) {
    const int steps = effort == Effort::TINY ? 2 : 8, repeats = effort == Effort::FULL ? 7 : 3;
    const Trial::State start = trial.state();
    double least = INFINITY;
    // The first repeat warms up.
    for (int repeat = 0; repeat <= repeats; repeat++) {
        trial.set_state(start);
        trial.cpu = 0;
        for (int i = 0; i < steps; i++) {
            load(trial, 1);
            trial.step(trial.setup.dt);
        }
        if (repeat > 0) least = std::min(least, trial.cpu);
    }
    trial.set_state(start);
    return least / (steps * trial.setup.dt);
}

double time_from(const Trial& rests, const Setup& setup, Effort effort, const LoadFunction& load) {
    Trial trial(rests.model, setup);
    trial.start_from(rests);
    load(trial, 1);
    return time_steps(trial, effort, load);
}

Outcome outcome_of(Trial& trial, double error, std::vector<Value> values, double cpu_per_second) {
    Outcome outcome;
    const frond_model_info info = trial.model->info();
    outcome.error = error;
    outcome.values = std::move(values);
    outcome.cpu_per_second = cpu_per_second;
    outcome.node_count = info.node_count;
    outcome.tet_count = info.tet_count;
    outcome.capsule_count = info.capsule_count;
    outcome.trouble = trial.trouble;
    return outcome;
}

}  // namespace frond::study
