// frond_kernels: the loops of a step by Google Benchmark, with the work that they do and how near that is to this
// processor's limits. Options are Google Benchmark's.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>

#include "kernels/kernels.hpp"

namespace frond::kernels {

namespace {

// Adds the share of its time that each run would need if it ran at the nearest limit.
class Reporter : public benchmark::ConsoleReporter {
public:
    explicit Reporter(const Ceilings& ceilings) : ConsoleReporter(OO_Tabular), ceilings(ceilings) {}
    void ReportRuns(const std::vector<Run>& runs) override {
        std::vector<Run> with_limits = runs;
        for (Run& run : with_limits) {
            const auto flops = run.counters.find("flop/s"), bytes = run.counters.find("byte/s");
            if (flops == run.counters.end() || bytes == run.counters.end()) continue;
            run.counters["of limit"] =
                std::max(flops->second.value / ceilings.products_and_sums, bytes->second.value / ceilings.triad_near);
        }
        ConsoleReporter::ReportRuns(with_limits);
    }

private:
    const Ceilings ceilings;
};

}  // namespace

}  // namespace frond::kernels

int main(int argc, char** argv) {
    using namespace frond::kernels;
    const std::vector<Kernel> kernels = make_kernels();
    if (argc == 2 && std::strcmp(argv[1], "--inside") == 0) {
        run_to_be_counted(kernels);
        return 0;
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const Ceilings ceilings = measure_ceilings();
    const std::map<std::string, Work> counted = count_work();
    std::printf(
        "one core at most: %.1f Gflop/s of products and sums (%.1f fused), %.0f GB/s in the first cache, %.0f GB/s in "
        "memory\n"
        "flops and bytes are counted instruction by instruction; \"of limit\" is what the nearer of flop/s and first "
        "cache allows\n",
        1e-9 * ceilings.products_and_sums, 1e-9 * ceilings.fused, 1e-9 * ceilings.triad_near,
        1e-9 * ceilings.triad_far);
    if (counted.empty())
        std::printf("valgrind or objdump did not count; install them with tools/install-packages and build again\n");
    for (const Kernel& kernel : kernels)
        benchmark::RegisterBenchmark(kernel.name.c_str(), [&kernel, &counted](benchmark::State& state) {
            for (auto _ : state) kernel.run();
            const double runs = double(state.iterations());
            state.counters["pieces/s"] = benchmark::Counter(runs * double(kernel.pieces), benchmark::Counter::kIsRate);
            const auto work = counted.find(kernel.name);
            if (work == counted.end()) return;
            state.counters["flop/s"] = benchmark::Counter(runs * work->second.flops, benchmark::Counter::kIsRate);
            state.counters["byte/s"] = benchmark::Counter(runs * work->second.bytes, benchmark::Counter::kIsRate);
            state.counters["flops a piece"] = work->second.flops / double(kernel.pieces);
        })->Unit(benchmark::kMicrosecond);
    Reporter reporter(ceilings);
    benchmark::RunSpecifiedBenchmarks(&reporter);
}
