// Stability: hard cases, each with every mechanics, implicit integrator and time step, and a criterion that can fail.
// Uses the public header only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frond/frond.h"

namespace frond::stability {

constexpr double COME_BACK = 4;  // time that most cases allow a plant to return [s]
// Allowed distance from the shape at rest after that, including any remaining vibration, in sizes of the plant [-].
constexpr double NEAR_LET_GO = 0.15, NEAR_DRIVEN = 0.25;

class Bench;

// One combination of settings for a case. The world's substeps are as long as the step, so that it is not divided.
struct Cell {
    frond_mechanics mechanics = FROND_MECHANICS_TET_COROTATIONAL;
    frond_integrator integrator = FROND_INTEGRATOR_BDF2;
    double dt = 1.0 / 60;  // [s]
};
std::string text_of(const Cell& cell);  // e.g. "rod, bdf2, 1/60 s"

struct Case {
    const char* name;
    const char* does;           // what happens to the plant
    const char* passes;         // the criterion in words
    void (*run)(Bench& bench);  // throws Broken if the criterion is not met, DoesNotApply if the case makes no sense
    bool is_slow = false;       // left out of the quick table
};
// Families of cases, one per file.
std::vector<Case> shape_cases();
std::vector<Case> matter_cases();
std::vector<Case> root_cases();
std::vector<Case> contact_cases();
std::vector<Case> crowd_cases();
std::vector<Case> time_cases();
std::vector<Case> corn_cases();
const std::vector<Case>& cases();
// Throws a SceneError that names the existing cases.
const Case& find_case(const std::string& name);

enum class Color { GREEN, RED, GREY };
struct Verdict {
    Color color = Color::RED;
    std::string text;        // why it is red or grey
    uint32_t trouble = 0;    // bits of all reports
    double seconds = 0;      // CPU time [s]
    bool is_missed = false;  // red by its criterion, not by a crash, a hang or a failed call
};
struct Result {
    const Case* of;
    Cell cell;
    Verdict verdict;
};

// The cells of a table: all of them, or those that a test has time for.
struct Scope {
    std::vector<std::string> names;  // names of cases; empty: all
    int mechanics = -1;              // -1: all
    int integrator = -1;             // -1: all
    bool quick = false;              // the default integrator at 1/60 s only, without the slow cases
};
std::vector<Result> cells_of(const Scope& scope);

struct Limits {
    int seconds = 120;  // CPU time per cell [s]
    int processes = 0;  // at once; 0: as many as there are processors
};
// Runs each job in a separate process; a crash or an exceeded time limit gives a red verdict.
std::vector<Verdict> run_apart(size_t count, const Limits& limits, const std::function<Verdict(size_t)>& job,
                               const std::function<void(int done)>& tell);
// Returns the verdict of a function that may throw Broken or DoesNotApply, and the time it took.
Verdict verdict_of(const std::function<void()>& run);
void run_cells(std::vector<Result>& results, const Limits& limits, const std::function<void(int done)>& tell);
Verdict run_cell(const Case& of, const Cell& cell);  // runs in this process

// Returns the reason why a method cannot meet the criterion that a red cell missed; null: it should.
const char* known_limit(const Result& result);
bool is_unexplained(const Result& result);  // red, and without a known limit

// Returns a table of Bullet's own soft bodies in the cases that apply to them, beside Frond's cells, at 1/60 s and,
// unless quick, at 1/240 s.
std::string bullet_table(bool quick, const Limits& limits, const std::function<void(int done, int all)>& tell);

std::string text_of(const std::vector<Result>& results);
std::string json_of(const std::vector<Result>& results);
std::string html_of(const std::vector<Result>& results);

}  // namespace frond::stability
