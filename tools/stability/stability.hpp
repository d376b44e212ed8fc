// Stability: hard cases, each over every mechanics, implicit integrator and time step, with a criterion that can fail.
// Sees the public header only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frond/frond.h"

namespace frond::stability {

constexpr double COME_BACK = 4;  // time that most cases give a plant to come back [s]
// How near it then is to the shape at rest, a sway that is left included; in sizes of the plant [-].
constexpr double NEAR_LET_GO = 0.15, NEAR_DRIVEN = 0.25;

class Bench;

// One choice of what a case is run with. The world's substeps are as long as the step: nothing divides it.
struct Cell {
    frond_mechanics mechanics = FROND_MECHANICS_TET_COROTATIONAL;
    frond_integrator integrator = FROND_INTEGRATOR_BDF2;
    double dt = 1.0 / 60;  // [s]
};
std::string text_of(const Cell& cell);  // "rod, bdf2, 1/60 s"

struct Case {
    const char* name;
    const char* does;           // what is done to the plant
    const char* passes;         // the criterion in words
    void (*run)(Bench& bench);  // throws Broken where it is not met, DoesNotApply where the case has no meaning
    bool is_slow = false;       // left out of the quick table
};
// Families of cases, each a file.
std::vector<Case> shape_cases();
std::vector<Case> matter_cases();
std::vector<Case> root_cases();
std::vector<Case> contact_cases();
std::vector<Case> crowd_cases();
std::vector<Case> time_cases();
std::vector<Case> corn_cases();
const std::vector<Case>& cases();
// Throws a SceneError that names the cases there are.
const Case& find_case(const std::string& name);

enum class Color { GREEN, RED, GREY };
struct Verdict {
    Color color = Color::RED;
    std::string text;        // why it is red or grey
    uint32_t trouble = 0;    // bits of all reports
    double seconds = 0;      // of CPU
    bool is_missed = false;  // red by its criterion, rather than by a crash, a hang or a call that failed
};
struct Result {
    const Case* of;
    Cell cell;
    Verdict verdict;
};

// The cells of a table: all of them, or those that a test has time for.
struct Scope {
    std::vector<std::string> names;  // of cases; empty: all
    int mechanics = -1;              // -1: all
    int integrator = -1;             // -1: all
    bool quick = false;              // the default integrator at 1/60 s only, without the slow cases
};
std::vector<Result> cells_of(const Scope& scope);

struct Limits {
    int seconds = 120;  // of CPU, a cell
    int processes = 0;  // at once; 0: as many as there are processors
};
// Each job is run in a process of its own; a crash, or a time limit that was overrun, is a red verdict.
std::vector<Verdict> run_apart(size_t count, const Limits& limits, const std::function<Verdict(size_t)>& job,
                               const std::function<void(int done)>& tell);
// What a function throws, Broken or DoesNotApply, and the time it took.
Verdict verdict_of(const std::function<void()>& run);
void run_cells(std::vector<Result>& results, const Limits& limits, const std::function<void(int done)>& tell);
Verdict run_cell(const Case& of, const Cell& cell);  // in this process

// Why a method cannot meet the criterion that a red cell missed; null: it should.
const char* known_limit(const Result& result);
bool is_unexplained(const Result& result);  // red, and without one

// Bullet's own soft bodies in the cases that they can be put through, beside what Frond's cells of these are, at 1/60 s
// and, unless it is to be quick, at 1/240 s.
std::string bullet_table(bool quick, const Limits& limits, const std::function<void(int done, int all)>& tell);

std::string text_of(const std::vector<Result>& results);
std::string json_of(const std::vector<Result>& results);
std::string html_of(const std::vector<Result>& results);

}  // namespace frond::stability
