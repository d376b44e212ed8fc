// Runs problems over their sweeps and their changes, each problem in a thread; equal setups are run once.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>

#include "study/figures.hpp"

namespace frond::study {
namespace {

// Runs setups and caches their results.
class Runner {
public:
    Runner(const Problem& problem, Session& session) : problem(problem), session(session) {}
    Point run(const std::string& series, const Setup& setup) {
        const std::string key = key_of(setup);
        auto known = done.find(key);
        if (known == done.end()) known = done.emplace(key, measure(setup)).first;
        Point point = known->second;
        point.series = series;
        return point;
    }

private:
    Point measure(const Setup& setup) {
        constexpr double LOST = 2;  // in units of the measured quantity: a larger error is meaningless
        Point point = {"", setup, {}, "", false, false};
        try {
            point.outcome = problem.run(setup, session);
            if (point.outcome.trouble & FROND_TROUBLE_REWOUND)
                point.failure = "unstable";
            else if (!(point.outcome.error < LOST))
                point.failure = "lost";
        } catch (const SceneError& error) {
            point.failure = error.what();
        }
        return point;
    }

    const Problem& problem;
    Session& session;
    std::map<std::string, Point> done;
};

// Collects this thread's warnings of the library for the report during its lifetime.
struct Warnings {
    int count = 0;
    std::string first;
    Warnings() { current = this; }
    Warnings(const Warnings&) = delete;
    Warnings& operator=(const Warnings&) = delete;
    ~Warnings() { current = nullptr; }
    static thread_local Warnings* current;
    static void take(const char* message, void*) {
        if (!current) return to_stderr(message, nullptr);
        if (current->count++ == 0) current->first = message;
    }
    static void to_stderr(const char* message, void*) { std::fprintf(stderr, "frond: %s\n", message); }
};
thread_local Warnings* Warnings::current = nullptr;

// The planned runs of a problem.
struct Plan {
    const Problem* problem;
    std::vector<Sweep> sweeps;
    std::vector<Setup> changes;
    int count() const {
        int sum = int(changes.size());
        for (const Sweep& sweep : sweeps) sum += int(sweep.setups.size());
        return sum;
    }
};

Result run_plan(const Plan& plan, Effort effort, const std::function<void()>& ran_one) {
    Session session;
    session.effort = effort;
    Runner runner(*plan.problem, session);
    const Warnings warnings;
    Result result = {plan.problem, {}, {}, {}, -cpu_now()};
    for (const Sweep& sweep : plan.sweeps)
        for (const Setup& setup : sweep.setups) {
            result.points.push_back(runner.run(sweep.name, setup));
            result.points.back().scattered = sweep.scattered;
            ran_one();
        }
    for (const Setup& setup : plan.changes) {
        result.changes.push_back(runner.run("", setup));
        ran_one();
    }
    result.cpu += cpu_now();
    mark_front(result.points);
    result.notes = session.notes;
    if (warnings.count > 0)
        result.notes.push_back("The library warned " + std::to_string(warnings.count) +
                               " times, first: " + warnings.first + ".");
    return result;
}

}  // namespace

std::vector<Result> run_problems(const std::vector<const Problem*>& problems, Effort effort, Watcher* watcher) {
    std::vector<Plan> plans;
    int total = 0;
    for (const Problem* problem : problems) {
        plans.push_back({problem, sweeps_of(*problem, effort), changes_of(*problem, effort)});
        total += plans.back().count();
    }
    std::vector<Result> results(plans.size());
    std::mutex watching;
    int count = 0;
    std::atomic<int> left = int(plans.size());
    std::exception_ptr failure;  // a file that cannot be written; a problem's own failure is a point of its diagram
    const auto run = [&](size_t k) {
        results[k] = run_plan(plans[k], effort, [&] {
            const std::lock_guard<std::mutex> lock(watching);
            if (watcher) watcher->at(++count, total);
        });
        const std::lock_guard<std::mutex> lock(watching);
        if (watcher) watcher->ended(results[k]);
    };
    const auto work = [&] {
        // The last problems of the table take longest, so they begin first.
        for (int i = --left; i >= 0; i = --left) try {
                run(size_t(i));
            } catch (...) {
                left = 0;
                const std::lock_guard<std::mutex> lock(watching);
                failure = std::current_exception();
            }
    };
    frond_set_log(Warnings::take, nullptr);
    std::vector<std::thread> threads(std::min<size_t>(plans.size(), std::max(1u, std::thread::hardware_concurrency())));
    for (std::thread& thread : threads) thread = std::thread(work);
    for (std::thread& thread : threads) thread.join();
    frond_set_log(Warnings::to_stderr, nullptr);
    if (failure) std::rethrow_exception(failure);
    return results;
}

const Problem& find_problem(const std::string& name) {
    std::string names;
    for (const Problem& problem : problems()) {
        if (name == problem.name) return problem;
        names += (names.empty() ? "" : ", ") + std::string(problem.name);
    }
    for (const FigureRow& figure : figures()) names += ", " + std::string(figure.name);
    throw SceneError("there is no problem \"" + name + "\"; there are all, " + names);
}

}  // namespace frond::study
