#include <sstream>

#include "study/report.hpp"

namespace frond::study {

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

static void add_row(std::ostringstream& out, const Point& point) {
    const Setup& setup = point.setup;
    const frond_plant_def& plant = setup.plant;
    const Outcome& outcome = point.outcome;
    const char* body = setup.body == Body::MESH ? "mesh" : setup.body == Body::STEM ? "stem" : "plant";
    out << csv_field(point.series.empty() ? "one at a time" : point.series) << ','
        << frond_mechanics_name(plant.mechanics) << ',' << body << ',' << setup.resolution << ',' << plant.element_order
        << ',' << setup.dt << ',' << frond_integrator_name(plant.integrator) << ',' << plant.tuning.newton_iterations
        << ',' << plant.tuning.newton_tolerance << ',' << frond_linear_solver_name(plant.tuning.linear_solver) << ','
        << plant.tuning.linear_tolerance << ',' << frond_mass_name(plant.tuning.mass) << ',';
    if (point.failure.empty())
        out << outcome.node_count << ',' << outcome.tet_count << ',' << outcome.capsule_count << ',' << outcome.error
            << ',' << outcome.cpu_per_second << ',' << (point.on_front ? 1 : 0) << ',';
    else
        out << ",,,,,0,";
    out << csv_field(point.failure);
    for (const Value& value : outcome.values)
        out << ',' << csv_field(value.name) << ',' << value.measured << ',' << value.known;
    out << '\n';
}

std::string csv_of(const Result& result, const Provenance& provenance) {
    std::ostringstream out;
    out.precision(8);
    out << "# " << result.problem->name << ": " << result.problem->measures << "; answer: " << result.problem->answer
        << "\n# error: " << result.problem->error << "\n# processor: " << provenance.processor
        << "\n# compiler: " << provenance.compiler << "\n# frond " << provenance.version << ", commit "
        << (provenance.commit.empty() ? "unknown" : provenance.commit) << "\n";
    for (const std::string& note : result.notes) out << "# " << note << "\n";
    out << "series,mechanics,body,resolution,element_order,time_step_s,integrator,newton_iterations,newton_tolerance,"
           "linear_solver,linear_tolerance,mass,nodes,tets,capsules,error,cpu_s_per_s,on_front,failure,"
           "figures (name; measured; known; repeated)\n";
    for (const Point& point : result.points) add_row(out, point);
    for (const Point& point : result.changes) add_row(out, point);
    return out.str();
}

}  // namespace frond::study
