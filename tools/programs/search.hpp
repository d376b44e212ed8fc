// Search: programs by chance, each run in a process of its own, and what they break.
#pragma once

#include <functional>
#include <string>

#include "programs/laws.hpp"

namespace frond::programs {

// What a program did.
struct Outcome {
    bool is_kept = true;   // all laws
    Law law = Law::COUNT;  // the broken one
    std::string text;      // how
    size_t operation = 0;  // in which; as many as there are: after all of them
    int steps = 0;         // of that operation
    uint64_t hash = 0;     // of the last step, if all are kept
    double seconds = 0;    // CPU time [s]
};
constexpr LawSet ALL_LAWS = bit_of(Law::COUNT) - 1;
// Runs a program here: with these laws, again with several threads, and home, as far as the laws need it.
Outcome outcome_of(const Program& program, LawSet laws = ALL_LAWS);
// Does the same in a child process, which may crash, or hang for longer than `seconds` of CPU time.
Outcome outcome_apart(const Program& program, int seconds, LawSet laws = ALL_LAWS);

struct Finding {
    uint64_t seed;
    Outcome outcome;
    Program program;  // shrunk
};
struct SearchSettings {
    int count = 100;        // number of programs
    uint64_t seed = 1;      // of the first; the others count on
    double seconds = 0;     // CPU time after which no more begin [s]; 0: any
    double shrinking = 60;  // CPU time for one shrinking [s]
    LawSet laws = ALL_LAWS;
    bool converged = false;  // see converge()
    int longest = 120;       // CPU time after which a program hangs [s]
};
struct SearchResult {
    int worlds = 0;
    double seconds = 0;  // CPU time of the programs, without shrinking [s]
    std::vector<Finding> findings;
};
SearchResult search(const SearchSettings& settings, const std::function<void(const Finding&)>& tell);

}  // namespace frond::programs
