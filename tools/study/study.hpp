// Study: named problems, each with every mechanics, resolution, element order, time step, integrator and solver, with
// their error and cost. Uses the public header only.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace frond::study {

using tools::must;
using tools::SceneError;

// Amount of work: enough for a test, for a coffee break, or all of it.
enum class Effort { TINY, QUICK, FULL };

// The simulated body.
enum class Body {
    MESH,  // a square beam of our own structured tets, simulated as they are
    STEM,  // a round stem, in Frond's calibrated cage or on its chain
    PLANT  // a plant from a file, in Frond's calibrated cage or on its chain
};

// Returns the default plant without plasticity: the known solutions are elastic.
inline frond_plant_def elastic_plant_def() {
    frond_plant_def def = frond_default_plant_def();
    def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    return def;
}

// One combination of all settings.
struct Setup {
    Body body = Body::STEM;
    int resolution = 10;   // MESH: cells across; STEM and PLANT: segments of cage or chain along the height
    double dt = 1.0 / 60;  // [s]
    frond_plant_def plant = elastic_plant_def();
};
// Returns whether the chain moves and the cage follows.
bool moves_chain(frond_mechanics mechanics);
// Returns the differences from `baseline`, "tet_corotational, stem, 10, 1/60 s, bdf2 ..."; "baseline" if none.
std::string difference(const Setup& setup, const Setup& baseline);
std::string resolution_text(const Setup& setup);
std::string time_step_text(double dt);
// Returns a key that is equal for setups that agree in everything that a study changes.
std::string key_of(const Setup& setup);

// A measured figure and its known value.
struct Value {
    std::string name;
    double measured, known;
};

// Result of a run of a problem.
struct Outcome {
    double error = 0;           // as defined by the problem
    double cpu_per_second = 0;  // CPU seconds per simulated second at the setup's time step
    std::vector<Value> values;
    int node_count = 0, tet_count = 0, capsule_count = 0;
    uint32_t trouble = 0;  // bits of frond_report
};

class Model;

// Data that a problem's runs share while a study runs: effort, and converged references.
struct Session {
    Effort effort = Effort::QUICK;
    std::vector<std::string> notes;  // sentences for the report, such as how well a reference converged
    std::map<std::string, std::vector<double>> references;
    std::map<std::string, std::shared_ptr<const Model>> models;
};

// Axes over which a problem is run.
enum Axis : unsigned {
    MECHANICS = 1,
    RESOLUTION = 2,  // including element order and body
    TIME_STEP = 4,   // including integrator
    NEWTON = 8,
    LINEAR = 16,
    EVERYTHING = 32  // mechanics, resolution, integrator and time step, in all combinations
};

// Returns the CPU time of this thread [s].
double cpu_now();

struct Problem {
    const char* name;
    const char* measures;
    const char* answer;  // the known solution, or how the reference is computed
    const char* error;   // definition of the error, with its unit
    unsigned axes;
    Setup (*baseline)();
    Outcome (*run)(const Setup& setup, Session& session);
};
const std::vector<Problem>& problems();
// Throws a SceneError that names the existing problems.
const Problem& find_problem(const std::string& name);

// Setups that form a line of the diagram.
struct Sweep {
    std::string name;
    std::vector<Setup> setups;
    bool scattered = false;  // many settings change at once: points without a line
};
std::vector<Sweep> sweeps_of(const Problem& problem, Effort effort);
// Returns the baseline, then setups with one setting changed at a time.
std::vector<Setup> changes_of(const Problem& problem, Effort effort);

// A point of a diagram, or a failed run.
struct Point {
    std::string series;  // empty: only in the one-at-a-time table
    Setup setup;
    Outcome outcome;
    std::string failure;  // empty: it succeeded
    bool on_front = false;
    bool scattered = false;
};

struct Result {
    const Problem* problem;
    std::vector<Point> points;   // points of the sweeps
    std::vector<Point> changes;  // one setting changed at a time, the baseline first
    std::vector<std::string> notes;
    double cpu = 0;  // CPU time of the whole problem [s]
};
class Watcher {  // is notified of a study's progress, by one thread at a time
public:
    virtual ~Watcher() = default;
    virtual void at(int done, int total) = 0;
    virtual void ended(const Result& result) = 0;
};
// Returns results in the given order. Problems run in parallel, one on each of the machine's cores; costs are CPU times
// of their own threads.
std::vector<Result> run_problems(const std::vector<const Problem*>& problems, Effort effort, Watcher* watcher);

// Marks the points that no other beats in both cost and error; failed ones are never on the front.
void mark_front(std::vector<Point>& points);

}  // namespace frond::study
