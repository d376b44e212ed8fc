// The table of cases, and the cells of a scope.
#include <algorithm>

#include "stability/bench.hpp"

namespace frond::stability {

const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        std::vector<Case> table;
        for (const auto& family :
             {shape_cases(), matter_cases(), root_cases(), contact_cases(), crowd_cases(), time_cases(), corn_cases()})
            table.insert(table.end(), family.begin(), family.end());
        return table;
    }();
    return all;
}

const Case& find_case(const std::string& name) {
    std::string names;
    for (const Case& one : cases()) {
        if (name == one.name) return one;
        names += (names.empty() ? "" : ", ") + std::string(one.name);
    }
    throw tools::SceneError("there is no case \"" + name + "\"; there are " + names);
}

std::string text_of(const Cell& cell) {
    const int per_second = int(1 / cell.dt + 0.5);
    return std::string(frond_mechanics_name(cell.mechanics)) + ", " + frond_integrator_name(cell.integrator) + ", 1/" +
           std::to_string(per_second) + " s";
}

std::vector<Result> cells_of(const Scope& scope) {
    const double steps[] = {1.0 / 240, 1.0 / 60, 1.0 / 30, 1.0 / 10};
    for (const std::string& name : scope.names) find_case(name);
    const int only = scope.quick ? FROND_INTEGRATOR_BDF2 : scope.integrator;
    std::vector<Result> cells;
    for (const Case& one : cases()) {
        const bool is_named = std::find(scope.names.begin(), scope.names.end(), one.name) != scope.names.end();
        if (scope.names.empty() ? scope.quick && one.is_slow : !is_named) continue;
        for (int mechanics = 0; mechanics < FROND_MECHANICS_COUNT; mechanics++)
            for (int integrator = 0; integrator < FROND_INTEGRATOR_SYMPLECTIC_EULER; integrator++)
                for (double dt : steps) {
                    if (scope.mechanics >= 0 && scope.mechanics != mechanics) continue;
                    if (only >= 0 && only != integrator) continue;
                    if (scope.quick && dt != 1.0 / 60) continue;
                    cells.push_back({&one, {frond_mechanics(mechanics), frond_integrator(integrator), dt}, {}});
                }
    }
    return cells;
}

}  // namespace frond::stability
