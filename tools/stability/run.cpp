// In: cells. Out: their verdicts, each determined in a separate process, so that a crash or a hang is a red cell.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <map>
#include <thread>

#include "stability/bench.hpp"

namespace frond::stability {

namespace {

double cpu_seconds() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

// Head of a child's report; the text follows.
struct Head {
    Color color;
    uint32_t trouble;
    double seconds;
    bool is_missed;
};

[[noreturn]] void run_child(const std::function<Verdict()>& job, int seconds, int out) {
    const rlim_t limit = rlim_t(seconds);
    const rlimit cpu = {limit, limit};
    setrlimit(RLIMIT_CPU, &cpu);
    alarm(unsigned(20 * seconds));  // ends a child that sleeps forever
    frond_set_log(nullptr, nullptr);
    const Verdict verdict = job();
    const Head head = {verdict.color, verdict.trouble, verdict.seconds, verdict.is_missed};
    bool written = write(out, &head, sizeof head) == ssize_t(sizeof head);
    written &= write(out, verdict.text.data(), verdict.text.size()) == ssize_t(verdict.text.size());
    _exit(written ? 0 : 1);
}

Verdict read_verdict(int in, int status, int seconds) {
    Verdict verdict;
    Head head;
    char text[400];
    if (read(in, &head, sizeof head) == ssize_t(sizeof head) && WIFEXITED(status)) {
        verdict.color = head.color;
        verdict.trouble = head.trouble;
        verdict.seconds = head.seconds;
        verdict.is_missed = head.is_missed;
        const ssize_t length = read(in, text, sizeof text);
        verdict.text.assign(text, size_t(length > 0 ? length : 0));
    } else if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGXCPU)) {
        verdict.text = "took more than " + std::to_string(seconds) + " s of CPU";
    } else {
        verdict.text =
            WIFSIGNALED(status) ? std::string("crashed: ") + strsignal(WTERMSIG(status)) : "ended without a word";
    }
    return verdict;
}

// Makes the models and calibrates them before forking, so that all children share them.
void warm_up() {
    for (int mechanics = 0; mechanics < FROND_MECHANICS_COUNT; mechanics++) {
        Bench bench({frond_mechanics(mechanics), FROND_INTEGRATOR_BDF2, 1.0 / 60});
        bench.add(herb());
        bench.add(beam(), {5, 0, 0});
        bench.run(0.05);
    }
}

}  // namespace

Verdict verdict_of(const std::function<void()>& run) {
    Verdict verdict;
    const double start = cpu_seconds();
    try {
        run();
        verdict.color = Color::GREEN;
    } catch (const DoesNotApply& reason) {
        verdict.color = Color::GREY;
        verdict.text = reason.what();
    } catch (const Broken& criterion) {
        verdict.is_missed = true;
        verdict.text = criterion.what();
    } catch (const std::exception& error) {
        verdict.text = error.what();
    }
    verdict.seconds = cpu_seconds() - start;
    return verdict;
}

Verdict run_cell(const Case& of, const Cell& cell) {
    Bench bench(cell);
    Verdict verdict = verdict_of([&] { of.run(bench); });
    verdict.trouble = bench.trouble;
    return verdict;
}

std::vector<Verdict> run_apart(size_t count, const Limits& limits, const std::function<Verdict(size_t)>& job,
                               const std::function<void(int)>& tell) {
    struct Child {
        size_t number;
        int out;
    };
    const size_t processes =
        size_t(limits.processes > 0 ? limits.processes : std::max(1, int(std::thread::hardware_concurrency())));
    std::vector<Verdict> verdicts(count);
    std::map<pid_t, Child> children;
    size_t next = 0;
    int done = 0;
    while (next < count || !children.empty()) {
        while (next < count && children.size() < processes) {
            int ends[2];
            if (pipe(ends) != 0) throw tools::SceneError(std::string("no pipe: ") + std::strerror(errno));
            const pid_t child = fork();
            if (child < 0) throw tools::SceneError(std::string("no process: ") + std::strerror(errno));
            if (child == 0) run_child([&] { return job(next); }, limits.seconds, ends[1]);
            close(ends[1]);
            children[child] = {next++, ends[0]};
        }
        int status = 0;
        const pid_t ended = waitpid(-1, &status, 0);
        const auto found = children.find(ended);
        if (found == children.end()) continue;
        verdicts[found->second.number] = read_verdict(found->second.out, status, limits.seconds);
        close(found->second.out);
        children.erase(found);
        tell(++done);
    }
    return verdicts;
}

void run_cells(std::vector<Result>& results, const Limits& limits, const std::function<void(int)>& tell) {
    warm_up();
    const std::vector<Verdict> verdicts = run_apart(
        results.size(), limits, [&](size_t i) { return run_cell(*results[i].of, results[i].cell); }, tell);
    for (size_t i = 0; i < results.size(); i++) results[i].verdict = verdicts[i];
}

}  // namespace frond::stability
