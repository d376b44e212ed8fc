// Program: a list of plain operations on a world through the public API, as data, so that it can be made at random,
// run, shortened, stored as text and written as C.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace frond::programs {

class Run;
class Source;

// What operations make, and act on.
enum class Kind { NONE, MODEL, PLANT, BODY, GRAB, BOND, ROBOT, SNAPSHOT };
const char* name_of(Kind kind);  // "plant"

enum class Scale { LINEAR, LOG, WHOLE };
struct Parameter {
    const char* name;
    double usual;      // its value in most operations, and the simplest one
    double low, high;  // range of other values
    double chance;     // chance of such a value [-]
    Scale scale = Scale::LINEAR;
};

struct Operation {
    size_t verb = 0;              // row of verbs()
    int id = 0;                   // names what it makes; 0: it makes nothing
    std::array<int, 2> of = {};   // ids of what it acts on
    std::vector<double> numbers;  // one a parameter
};
struct Program {
    std::vector<Operation> operations;  // the first one makes the world
};

struct Verb {
    const char* name;
    Kind makes;
    std::array<Kind, 2> of;
    int weight;  // how often a random program has it; 0: never by itself
    std::vector<Parameter> parameters;
    void (*run)(Run& run, const Operation& operation);
    void (*write)(Source& source, const Operation& operation);
};
// Rows of the table, by what they act on.
std::vector<Verb> world_verbs();
std::vector<Verb> snapshot_verbs();
std::vector<Verb> model_verbs();
std::vector<Verb> plant_verbs();
std::vector<Verb> state_verbs();
std::vector<Verb> hold_verbs();
std::vector<Verb> body_verbs();
const std::vector<Verb>& verbs();
size_t verb_called(const std::string& name);  // throws a SceneError for an unknown name
const Verb& verb_of(const Operation& operation);

// Returns the number of a parameter by its name.
double number(const Operation& operation, const char* name);
int whole(const Operation& operation, const char* name);

// Makes a program by chance: the same for the same seed.
Program random_program(uint64_t seed);
// Has all plants take each step by implicit Euler to balance: what then breaks a law is not the fault of steps that do
// not converge.
void converge(Program& program);
// Removes operations on what nothing has made.
void prune(Program& program);

// A line per operation: its verb, the ids, and the numbers that are not as usual, "plant 4 1 x=0.1 mechanics=3".
std::string text_of(const Program& program);
Program program_from(const std::string& text);  // throws a SceneError that names the line
std::string text_of(double value);              // the shortest that reads as the same number

}  // namespace frond::programs
