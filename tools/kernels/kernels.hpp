// Kernels: the loops that a step spends its time in, each alone, beside what this processor could do at most.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace frond::kernels {

struct Kernel {
    std::string name;
    size_t pieces;  // tets, rods or blocks of three numbers that it goes through
    std::function<void()> run;
};
std::vector<Kernel> make_kernels();

// The work of one run of a kernel.
struct Work {
    double instructions = 0;
    double flops = 0;  // additions, subtractions, products, quotients and roots
    double bytes = 0;  // read and written, in whichever cache
};
// Counts the work of each kernel, by its name: this program runs itself in valgrind's callgrind, and objdump tells what
// each instruction is. Empty if one of them is missing.
std::map<std::string, Work> count_work();
// Runs the kernels for callgrind to count.
void run_to_be_counted(const std::vector<Kernel>& kernels);

// The measured limits of one core; all in a second.
struct Ceilings {
    double products_and_sums;  // four lanes, each rounded by itself, as Frond has them [flop/s]
    double fused;              // the same as fused products, which Frond does without [flop/s]
    double triad_near;         // a = b + s c in the first cache [byte/s]
    double triad_far;          // and in memory [byte/s]
};
Ceilings measure_ceilings();

}  // namespace frond::kernels
