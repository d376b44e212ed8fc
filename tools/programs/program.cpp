#include "programs/program.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

#include "scenes/scene.hpp"

namespace frond::programs {

using tools::SceneError;

const char* name_of(Kind kind) {
    static const char* const NAMES[] = {"", "model", "plant", "body", "grab", "bond", "robot", "snapshot"};
    return NAMES[size_t(kind)];
}

const std::vector<Verb>& verbs() {
    static const std::vector<Verb> table = [] {
        std::vector<Verb> all;
        for (const auto& rows :
             {world_verbs(), snapshot_verbs(), model_verbs(), plant_verbs(), state_verbs(), hold_verbs(), body_verbs()})
            all.insert(all.end(), rows.begin(), rows.end());
        return all;
    }();
    return table;
}

size_t verb_called(const std::string& name) {
    for (size_t i = 0; i < verbs().size(); i++)
        if (name == verbs()[i].name) return i;
    throw SceneError("there is no operation \"" + name + "\"");
}

const Verb& verb_of(const Operation& operation) {
    return verbs()[operation.verb];
}

static size_t parameter_called(const Verb& verb, const std::string& name) {
    for (size_t i = 0; i < verb.parameters.size(); i++)
        if (name == verb.parameters[i].name) return i;
    throw SceneError(std::string("the operation ") + verb.name + " has no " + name);
}

double number(const Operation& operation, const char* name) {
    return operation.numbers[parameter_called(verb_of(operation), name)];
}

int whole(const Operation& operation, const char* name) {
    return int(std::lround(number(operation, name)));
}

void converge(Program& program) {
    constexpr int ITERATIONS = 16;
    const size_t plant = verb_called("plant"), integrator = verb_called("integrator");
    for (Operation& operation : program.operations) {
        const Verb& verb = verb_of(operation);
        if (operation.verb == integrator) operation.numbers[0] = FROND_INTEGRATOR_IMPLICIT_EULER;
        if (operation.verb != plant) continue;
        operation.numbers[parameter_called(verb, "integrator")] = FROND_INTEGRATOR_IMPLICIT_EULER;
        operation.numbers[parameter_called(verb, "newton_iterations")] = ITERATIONS;
        operation.numbers[parameter_called(verb, "linear_solver")] = FROND_LINEAR_SOLVER_BLOCK;
    }
}

void prune(Program& program) {
    std::set<int> made = {0};
    std::vector<Operation> kept;
    for (Operation& operation : program.operations) {
        if (!made.count(operation.of[0]) || !made.count(operation.of[1])) continue;
        made.insert(operation.id);
        kept.push_back(std::move(operation));
    }
    program.operations = std::move(kept);
}

std::string text_of(double value) {
    char text[40];
    for (int digits = 6; digits <= 17; digits++) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) == value) break;
    }
    return text;
}

std::string text_of(const Program& program) {
    std::string text;
    for (const Operation& operation : program.operations) {
        const Verb& verb = verb_of(operation);
        text += verb.name;
        if (verb.makes != Kind::NONE) text += " " + std::to_string(operation.id);
        for (size_t k = 0; k < 2; k++)
            if (verb.of[k] != Kind::NONE) text += " " + std::to_string(operation.of[k]);
        for (size_t i = 0; i < operation.numbers.size(); i++)
            if (operation.numbers[i] != verb.parameters[i].usual)
                text += std::string(" ") + verb.parameters[i].name + "=" + text_of(operation.numbers[i]);
        text += "\n";
    }
    return text;
}

static Operation operation_from(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    Operation operation;
    operation.verb = verb_called(word);
    const Verb& verb = verb_of(operation);
    for (const Parameter& parameter : verb.parameters) operation.numbers.push_back(parameter.usual);
    const auto take = [&](Kind kind, int& id) {
        if (kind != Kind::NONE && !(words >> id))
            throw SceneError(std::string("it needs the number of a ") + name_of(kind));
    };
    take(verb.makes, operation.id);
    for (size_t k = 0; k < 2; k++) take(verb.of[k], operation.of[k]);
    while (words >> word) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos) throw SceneError("\"" + word + "\" is no name=number");
        char* end = nullptr;
        const double value = std::strtod(word.c_str() + equals + 1, &end);
        if (*end || !std::isfinite(value)) throw SceneError("\"" + word + "\" has no number");
        operation.numbers[parameter_called(verb, word.substr(0, equals))] = value;
    }
    return operation;
}

Program program_from(const std::string& text) {
    Program program;
    std::istringstream lines(text);
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
        count++;
        if (line.empty() || line[0] == '#') continue;
        try {
            program.operations.push_back(operation_from(line));
        } catch (const SceneError& error) {
            throw SceneError("line " + std::to_string(count) + ": " + error.what());
        }
    }
    if (program.operations.empty() || std::strcmp(verb_of(program.operations[0]).name, "world") != 0)
        throw SceneError("a program begins with the operation world");
    prune(program);
    return program;
}

}  // namespace frond::programs
