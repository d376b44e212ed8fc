// Runs a problem over its sweeps and its changes; equal setups are run once.
#include <cstdio>

#include "study/figures.hpp"

namespace frond::study {
namespace {

// Runs setups and remembers what they gave.
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
        constexpr double LOST = 2;  // times what is measured: such an error says nothing more
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

// Takes the library's warnings for the report while it lives.
struct Warnings {
    int count = 0;
    std::string first;
    Warnings() { frond_set_log(take, this); }
    Warnings(const Warnings&) = delete;
    Warnings& operator=(const Warnings&) = delete;
    ~Warnings() { frond_set_log(to_stderr, nullptr); }
    static void take(const char* message, void* user) {
        Warnings& warnings = *static_cast<Warnings*>(user);
        if (warnings.count++ == 0) warnings.first = message;
    }
    static void to_stderr(const char* message, void*) { std::fprintf(stderr, "frond: %s\n", message); }
};

}  // namespace

Result run_problem(const Problem& problem, Effort effort, Watcher* watcher) {
    Session session;
    session.effort = effort;
    Runner runner(problem, session);
    const Warnings warnings;
    const std::vector<Sweep> sweeps = sweeps_of(problem, effort);
    const std::vector<Setup> changes = changes_of(problem, effort);
    int total = int(changes.size()), count = 0;
    for (const Sweep& sweep : sweeps) total += int(sweep.setups.size());

    Result result = {&problem, {}, {}, {}};
    const auto tell = [&] {
        if (watcher) watcher->at(problem.name, ++count, total);
    };
    for (const Sweep& sweep : sweeps)
        for (const Setup& setup : sweep.setups) {
            result.points.push_back(runner.run(sweep.name, setup));
            result.points.back().scattered = sweep.scattered;
            tell();
        }
    for (const Setup& setup : changes) {
        result.changes.push_back(runner.run("", setup));
        tell();
    }
    mark_front(result.points);
    result.notes = session.notes;
    if (warnings.count > 0)
        result.notes.push_back("The library warned " + std::to_string(warnings.count) +
                               " times, first: " + warnings.first + ".");
    return result;
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
