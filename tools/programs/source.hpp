// Source: a program written as C, or as C++ where a Bullet world of the host's has its plants.
#pragma once

#include "frond/frond.h"
#include "programs/program.hpp"

namespace frond::programs {

class Source {
public:
    explicit Source(const Program& program);
    // Adds a line to main(), in printf's way.
    void line(const char* format, ...) __attribute__((format(printf, 2, 3)));
    void text(const std::string& lines) { body += lines; }
    // Adds lines that set those fields of a def that are not as usual: `fields` are pairs of the field and the
    // parameter.
    void fields(const std::string& def, const Operation& operation,
                std::initializer_list<std::array<const char*, 2>> fields);
    // Returns the call of a step.
    std::string step_call(double rate) const;
    // Adds an array of numbers.
    void numbers(const std::string& type, const std::string& name, const std::vector<double>& values, int in_a_line);
    int host = -1;  // kind of the host's world; -1: Frond's own

private:
    friend std::string c_source(const Program& program, const std::string& remark);
    std::string body;
};

// Returns the whole file; it prints the energy ledger now and then, and the state's hash at its end. `remark` stands
// above it.
std::string c_source(const Program& program, const std::string& remark);
bool needs_cpp(const Program& program);

std::string plant_name(const Operation& operation);  // of the first thing that it acts on, "plant_4"
// Returns the three numbers, "1, 0, 0.5".
std::string vec_text(const frond_vec3& v);

}  // namespace frond::programs
