// Study: named problems, each over every mechanics, resolution, element order, time step, integrator and solver, with
// its error and its cost. Sees the public header only.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace frond::study {

using tools::must;
using tools::SceneError;

// How much is done: what a test has time for, what a coffee break has, all of it.
enum class Effort { TINY, QUICK, FULL };

// The simulated body.
enum class Body {
    MESH,  // a square beam of structured tets of our own, simulated as they are
    STEM,  // a round stem, in Frond's calibrated cage or on its chain
    PLANT  // a plant from a file, in Frond's calibrated cage or on its chain
};

// The default plant, but that nothing yields: the known answers are elastic ones.
inline frond_plant_def elastic_plant_def() {
    frond_plant_def def = frond_default_plant_def();
    def.effects &= ~uint32_t(FROND_EFFECT_PLASTICITY);
    return def;
}

// One choice of everything that can be chosen.
struct Setup {
    Body body = Body::STEM;
    int resolution = 10;   // MESH: cells across; STEM and PLANT: pieces of cage or chain along the height
    double dt = 1.0 / 60;  // [s]
    frond_plant_def plant = elastic_plant_def();
};
// Tells whether the chain moves and the cage follows.
bool moves_chain(frond_mechanics mechanics);
// "tet_corotational, stem, 10, 1/60 s, bdf2 ..." of what differs from `baseline`; "baseline" if nothing does.
std::string difference(const Setup& setup, const Setup& baseline);
std::string resolution_text(const Setup& setup);
std::string time_step_text(double dt);
// Equal for setups that are the same in everything that a study changes.
std::string key_of(const Setup& setup);

// A figure that was measured, beside what it should be.
struct Value {
    std::string name;
    double measured, known;
};

// The result of a run of a problem.
struct Outcome {
    double error = 0;           // as the problem defines it
    double cpu_per_second = 0;  // CPU seconds per simulated second at the setup's time step
    std::vector<Value> values;
    int node_count = 0, tet_count = 0, capsule_count = 0;
    uint32_t trouble = 0;  // bits of frond_report
};

class Model;

// Data that problems share while a study runs: how much to do, and converged references.
struct Session {
    Effort effort = Effort::QUICK;
    std::vector<std::string> notes;  // sentences for the report, such as how well a reference converged
    std::map<std::string, std::vector<double>> references;
    std::map<std::string, std::shared_ptr<const Model>> models;
};

// The axes that a problem is run over.
enum Axis : unsigned {
    MECHANICS = 1,
    RESOLUTION = 2,  // with element order and body
    TIME_STEP = 4,   // with integrator
    NEWTON = 8,
    LINEAR = 16,
    EVERYTHING = 32  // mechanics, resolution, integrator and time step, each with each
};

// CPU time of this thread [s].
double cpu_now();

struct Problem {
    const char* name;
    const char* measures;
    const char* answer;  // the known answer, or how the reference is made
    const char* error;   // what the error is, with its unit
    unsigned axes;
    Setup (*baseline)();
    Outcome (*run)(const Setup& setup, Session& session);
};
const std::vector<Problem>& problems();
// Throws a SceneError that names the problems there are.
const Problem& find_problem(const std::string& name);

// Setups that belong together: a line in the diagram.
struct Sweep {
    std::string name;
    std::vector<Setup> setups;
    bool scattered = false;  // many settings at once: points without a line
};
std::vector<Sweep> sweeps_of(const Problem& problem, Effort effort);
// The baseline, then one setting changed at a time.
std::vector<Setup> changes_of(const Problem& problem, Effort effort);

// A point of a diagram, or a run that failed.
struct Point {
    std::string series;  // empty: of the one-at-a-time table only
    Setup setup;
    Outcome outcome;
    std::string failure;  // empty: it ran
    bool on_front = false;
    bool scattered = false;
};

struct Result {
    const Problem* problem;
    std::vector<Point> points;   // of the sweeps
    std::vector<Point> changes;  // one at a time, the baseline first
    std::vector<std::string> notes;
    double cpu = 0;  // of the whole problem [s]
};
class Watcher {  // is told how far a study is, by one thread at a time
public:
    virtual ~Watcher() = default;
    virtual void at(int done, int total) = 0;
    virtual void ended(const Result& result) = 0;
};
// In the given order. Problems run beside each other, one on each of the machine's cores; costs are of their own
// threads.
std::vector<Result> run_problems(const std::vector<const Problem*>& problems, Effort effort, Watcher* watcher);

// Marks those points that no other beats in both cost and error; failed ones are never on the front.
void mark_front(std::vector<Point>& points);

}  // namespace frond::study
