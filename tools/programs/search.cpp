#include "programs/search.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>

#include "programs/copy.hpp"
#include "programs/run.hpp"
#include "programs/shrink.hpp"

namespace frond::programs {

namespace {

double cpu_seconds(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

// Head of a child's report; the text follows.
struct Head {
    bool is_kept;
    Law law;
    size_t operation;
    int steps;
    uint64_t hash;
    double seconds;
};

[[noreturn]] void run_child(const Program& program, int seconds, LawSet laws, int out) {
    const rlim_t limit = rlim_t(seconds);
    const rlimit cpu = {limit, limit};
    setrlimit(RLIMIT_CPU, &cpu);
    alarm(unsigned(20 * seconds));  // ends a child that sleeps forever
    frond_set_log(nullptr, nullptr);
    const Outcome outcome = outcome_of(program, laws);
    const Head head = {outcome.is_kept, outcome.law, outcome.operation, outcome.steps, outcome.hash, outcome.seconds};
    bool written = write(out, &head, sizeof head) == ssize_t(sizeof head);
    written &= write(out, outcome.text.data(), outcome.text.size()) == ssize_t(outcome.text.size());
    _exit(written ? 0 : 1);
}

Outcome read_outcome(int in, int status, int seconds) {
    Outcome outcome;
    Head head;
    char text[400];
    if (read(in, &head, sizeof head) == ssize_t(sizeof head) && WIFEXITED(status)) {
        outcome = {head.is_kept, head.law, {}, head.operation, head.steps, head.hash, head.seconds};
        const ssize_t length = read(in, text, sizeof text);
        outcome.text.assign(text, size_t(length > 0 ? length : 0));
        return outcome;
    }
    outcome.is_kept = false;
    outcome.law = Law::CRASH;
    outcome.operation = SIZE_MAX;
    const bool hangs = WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGXCPU);
    if (hangs)
        outcome.text = "took more than " + std::to_string(seconds) + " s of CPU";
    else
        outcome.text = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "ended without a word";
    return outcome;
}

// Loads what children would otherwise each load again.
void warm_up() {
    Program program = program_from(
        "world\nmodel 1 file=0\nmodel 2 file=1\nmodel 3 file=2\nmodel 4 file=3\n"
        "model 5 file=4\nmodel 6 file=5\n");
    Run(program, {1, 0}).go();
}

Finding shrunk(uint64_t seed, Program program, const Outcome& outcome, const SearchSettings& settings) {
    constexpr int SHORT = 15;  // a candidate that takes longer is not simpler [s]
    const LawSet laws = outcome.law == Law::CRASH ? settings.laws : bit_of(outcome.law);
    // What comes after the breach has no part in it.
    if (outcome.operation < program.operations.size()) program.operations.resize(outcome.operation + 1);
    Finding finding = {seed, outcome, program};
    const double begin = cpu_seconds(CLOCK_MONOTONIC);
    const auto is_over = [&] { return cpu_seconds(CLOCK_MONOTONIC) - begin > settings.shrinking; };
    finding.program = shrink(
        std::move(program),
        [&](Program candidate) {
            if (settings.converged) converge(candidate);
            const int longest = outcome.law == Law::CRASH ? settings.longest : SHORT;
            const Outcome now = outcome_apart(candidate, longest, laws);
            if (now.is_kept || now.law != outcome.law) return false;
            finding.outcome = now;
            return true;
        },
        is_over);
    if (settings.converged) converge(finding.program);
    return finding;
}

// Runs the program again, with several threads and without a ledger, so that plants that go alike are stepped together.
void expect_same_bits(const Program& program, const Run& first) {
    constexpr int THREADS = 3;
    Run again(program, {THREADS, 0});
    again.go();
    if (again.hashes.size() != first.hashes.size()) throw Breach(Law::BITS, "another number of steps");
    for (size_t i = 0; i < first.hashes.size(); i++)
        if (again.hashes[i] != first.hashes[i])
            throw Breach(Law::BITS, "another state after step " + std::to_string(i + 1));
}

}  // namespace

Outcome outcome_of(const Program& program, LawSet laws) {
    Outcome outcome;
    const double begin = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    Run first(program, {1, laws});
    const auto breaks = [&](const Run& run, Law law, const std::string& text) {
        outcome.is_kept = false;
        outcome.law = law;
        outcome.text = text;
        outcome.operation = run.at;
        outcome.steps = run.steps;
    };
    try {
        first.go();
        if (laws & bit_of(Law::BITS)) expect_same_bits(program, first);
        outcome.hash = first.hash();
        if (laws & bit_of(Law::HOME)) first.come_home();
    } catch (const Breach& breach) {
        breaks(first, breach.law, breach.what());
    } catch (const std::exception& error) {
        breaks(first, Law::CALL, error.what());
    }
    outcome.seconds = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - begin;
    return outcome;
}

Outcome outcome_apart(const Program& program, int seconds, LawSet laws) {
    Outcome outcome;
    run_in_copy([&](int out) { run_child(program, seconds, laws, out); },
                [&](int in, int status) { outcome = read_outcome(in, status, seconds); });
    return outcome;
}

SearchResult search(const SearchSettings& settings, const std::function<void(const Finding&)>& tell) {
    warm_up();
    SearchResult result;
    for (int i = 0; i < settings.count && (settings.seconds <= 0 || result.seconds < settings.seconds); i++) {
        const uint64_t seed = settings.seed + uint64_t(i);
        Program program = random_program(seed);
        if (settings.converged) converge(program);
        const Outcome outcome = outcome_apart(program, settings.longest, settings.laws);
        result.worlds++;
        result.seconds += outcome.law == Law::CRASH ? settings.longest : outcome.seconds;
        if (outcome.is_kept) continue;
        result.findings.push_back(shrunk(seed, program, outcome, settings));
        tell(result.findings.back());
    }
    return result;
}

}  // namespace frond::programs
