#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "study/report.hpp"

namespace frond::study {

// "FROND_MECHANICS_", "tet_linear" -> "FROND_MECHANICS_TET_LINEAR"
static std::string enum_name(const char* prefix, const std::string& name) {
    std::string text = prefix;
    for (char c : name) text += char(std::toupper(c));
    return text;
}

// Linear tets are right for small bends only, and a chain of springs for round organs only: they appear in the diagram,
// but their error there is no reason to recommend them.
static bool is_right_everywhere(frond_mechanics mechanics) {
    return mechanics != FROND_MECHANICS_TET_LINEAR && mechanics != FROND_MECHANICS_SPRING_CHAIN;
}

std::string advice_of(const Result& result, const Provenance& provenance) {
    std::vector<Point> points;
    for (const Point& point : result.points)
        if (is_right_everywhere(point.setup.plant.mechanics)) points.push_back(point);
    mark_front(points);
    std::vector<const Point*> front;
    for (const Point& point : points)
        if (point.on_front) front.push_back(&point);
    std::sort(front.begin(), front.end(),
              [](const Point* a, const Point* b) { return a->outcome.cpu_per_second < b->outcome.cpu_per_second; });
    std::ostringstream out;
    out << "// Made by `frond study sway --advice plugin/src/api/recommend_front.inc` on " << provenance.processor
        << ", " << provenance.compiler
        << "; do not edit.\n// mechanics, integrator, pieces, steps a period, error [-], CPU a "
        << "step [s], capsules or tets\n";
    out.precision(4);
    constexpr double WORTHWHILE = 0.95;  // largest error of a row relative to the one before it [-]
    double before = INFINITY;
    for (const Point* point : front) {
        if (point->outcome.error > WORTHWHILE * before) continue;
        before = point->outcome.error;
        const Setup& setup = point->setup;
        const Outcome& o = point->outcome;
        out << '{' << enum_name("FROND_MECHANICS_", frond_mechanics_name(setup.plant.mechanics)) << ", "
            << enum_name("FROND_INTEGRATOR_", frond_integrator_name(setup.plant.integrator)) << ", " << setup.resolution
            << ", " << 1 / (setup.dt * o.values.at(0).known) << ", " << o.error << ", " << o.cpu_per_second * setup.dt
            << ", " << (moves_chain(setup.plant.mechanics) ? o.capsule_count : o.tet_count) << "},\n";
    }
    return out.str();
}

}  // namespace frond::study
