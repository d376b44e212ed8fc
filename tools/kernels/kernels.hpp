// Kernels: the loops that take a step's time, each alone, compared with the most that this processor can do.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace frond::kernels {

struct Kernel {
    std::string name;
    size_t pieces;  // number of tets, rods or blocks of three numbers that it processes
    std::function<void()> run;
};
std::vector<Kernel> make_kernels();

// The work of one run of a kernel.
struct Work {
    double instructions = 0;
    double flops = 0;  // additions, subtractions, products, quotients and roots
    double bytes = 0;  // bytes read and written, in any cache
};
// Counts the work of each kernel, by its name: this program runs itself in Valgrind's callgrind, and objdump names each
// instruction. Empty if either is missing.
std::map<std::string, Work> count_work();
// Runs the kernels for callgrind to count.
void run_to_be_counted(const std::vector<Kernel>& kernels);

// The measured limits of one core; measuring them all takes a second.
struct Ceilings {
    double products_and_sums;  // four lanes, product and sum rounded separately, as in Frond [flop/s]
    double fused;              // the same as fused products, which Frond does not use [flop/s]
    double triad_near;         // a = b + s c in the first-level cache [byte/s]
    double triad_far;          // the same in memory [byte/s]
};
Ceilings measure_ceilings();

}  // namespace frond::kernels
