#include "programs/source.hpp"

#include <cstdarg>
#include <cstdio>

#include "programs/host.hpp"

namespace frond::programs {

namespace {

// Functions that operations call, the same as in run.cpp; each file has those that it needs. Later ones call earlier
// ones.
struct Helper {
    const char* name;
    const char* text;
};
constexpr Helper HELPERS[] = {{"tell", R"(
/* Prints the energy ledger. */
static void tell(void) {
    frond_energy_ledger ledger;
    if (frond_world_get_energy_ledger(world, &ledger) != FROND_OK) return;
    printf("kinetic %g elastic %g gravity %g dissipated %g (error %g) J\n", ledger.now.kinetic, ledger.now.elastic,
           ledger.now.gravity, ledger.dissipated, ledger.error);
}
)"},
                              {"vec", R"(
static frond_vec3 vec(double x, double y, double z) {
    frond_vec3 v;
    v.x = x, v.y = y, v.z = z;
    return v;
}
)"},
                              {"vertex", R"(
/* The place of a vertex of a plant's surface. */
static frond_vec3 vertex(frond_plant plant, int number) {
    frond_surface_view view;
    frond_vec3 place = {0, 0, 0};
    if (frond_plant_get_surface(plant, &view) == FROND_OK) {
        const float* p = view.positions + 3 * (number % view.vertex_count);
        place.x = p[0], place.y = p[1], place.z = p[2];
    }
    return place;
}
)"},
                              {"node", R"(
static int node(frond_plant plant, int number) {
    const int count = frond_plant_get_node_count(plant);
    return count > 0 ? number % count : 0;
}
)"},
                              {"moved", R"(
static frond_vec3 moved(frond_vec3 a, double x, double y, double z) {
    a.x += x, a.y += y, a.z += z;
    return a;
}
)"},
                              {"state", R"(
/* Positions of a plant's nodes, then their velocities; the caller frees them. */
static frond_vec3* state(frond_plant plant) {
    const int count = frond_plant_get_node_count(plant);
    frond_vec3* x = (frond_vec3*)calloc(2 * (size_t)count + 1, sizeof *x);
    if (x) frond_plant_get_state(plant, &x[0].x, &x[count].x, count);
    return x;
}
)"},
                              {"place", R"(
static frond_vec3 place(frond_plant plant, int number) {
    frond_vec3 at = {0, 0, 0}, *x = state(plant);
    if (x && number < frond_plant_get_node_count(plant)) at = x[number];
    free(x);
    return at;
}
)"},
                              {"copy_state", R"(
static void copy_state(frond_plant from, frond_plant to) {
    const int count = frond_plant_get_node_count(from);
    frond_vec3* x = state(from);
    if (x) frond_plant_set_state(to, &x[0].x, &x[count].x, count);
    free(x);
}
)"},
                              {"share", R"(
/* The height of a point as a share of that of all. */
static double share(const frond_vec3* x, int count, double y) {
    double low = 1e9, high = -1e9;
    for (int i = 0; i < count; i++) {
        if (x[i].y < low) low = x[i].y;
        if (x[i].y > high) high = x[i].y;
    }
    return (y - low) / (high - low + 1e-9);
}
)"},
                              {"kick", R"(
/* Adds a velocity to a plant's nodes, from none at its foot to all at its top. */
static void kick(frond_plant plant, double vx, double vy, double vz) {
    const int count = frond_plant_get_node_count(plant);
    frond_vec3* x = state(plant);
    for (int i = 0; x && i < count; i++) {
        const double s = share(x, count, x[i].y);
        x[count + i] = moved(x[count + i], s * vx, s * vy, s * vz);
    }
    if (x) frond_plant_set_state(plant, NULL, &x[count].x, count);
    free(x);
}
)"},
                              {"bend", R"(
/* Moves a plant's nodes, by the square of their height. */
static void bend(frond_plant plant, double dx, double dy, double dz) {
    const int count = frond_plant_get_node_count(plant);
    frond_vec3 *x = state(plant), *to = state(plant);
    for (int i = 0; x && to && i < count; i++) {
        const double s = share(x, count, x[i].y);
        to[i] = moved(x[i], s * s * dx, s * s * dy, s * s * dz);
    }
    if (to) frond_plant_set_state(plant, &to[0].x, NULL, count);
    free(x);
    free(to);
}
)"},
                              {"blow", R"(
static double within_5(double number) {
    return number < -5 ? -5 : number > 5 ? 5 : number;
}

/* A wind that grows with height and turns about the origin, the same from 5 m on. */
static void blow(const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user) {
    const double strength = *(const double*)user;
    (void)time;
    for (int i = 0; i < count; i++)
        velocities[i].x += strength * within_5(points[i].y), velocities[i].z -= strength * within_5(points[i].x);
}
)"}};

// Returns the helpers that a text calls, and those that they call.
std::string helpers_of(std::string text) {
    std::string found;
    for (size_t i = sizeof HELPERS / sizeof *HELPERS; i-- > 0;) {
        const std::string name = HELPERS[i].name;
        const bool is_called = text.find(name + "(") != std::string::npos || text.find(name + ",") != std::string::npos;
        if (!is_called) continue;
        found = HELPERS[i].text + found;
        text += HELPERS[i].text;
    }
    return found;
}

constexpr const char* END = R"(
    uint64_t hash = 0;
    frond_world_get_state_hash(world, &hash);
    printf("hash %016llx\n", (unsigned long long)hash);
    frond_world_destroy(world);
    return 0;
}
)";

}  // namespace

std::string plant_name(const Operation& operation) {
    return "plant_" + std::to_string(operation.of[0]);
}

std::string vec_text(const frond_vec3& v) {
    return text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z);
}

// Operations that declare variables of their own have a block.
Source::Source(const Program& program) {
    for (const Operation& operation : program.operations) {
        const size_t before = body.size();
        verb_of(operation).write(*this, operation);
        const std::string text = body.substr(before);
        const bool declares =
            text.find("    frond_") == 0 || text.find("    static ") == 0 || text.find("    const ") == 0;
        const bool has_lines = text.find('\n') != text.size() - 1;
        if (verb_of(operation).makes == Kind::NONE && &operation != &program.operations[0] && declares && has_lines)
            body = body.substr(0, before) + "    {\n" + text + "    }\n";
    }
}

void Source::line(const char* format, ...) {
    char text[1000];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    body += std::string("    ") + text + "\n";
}

void Source::fields(const std::string& def, const Operation& operation,
                    std::initializer_list<std::array<const char*, 2>> fields) {
    const Verb& verb = verb_of(operation);
    for (const auto& [field, parameter] : fields)
        for (size_t i = 0; i < verb.parameters.size(); i++)
            if (std::string(parameter) == verb.parameters[i].name && operation.numbers[i] != verb.parameters[i].usual) {
                std::string value = text_of(operation.numbers[i]);
                // Enums need a cast in C++.
                const std::string name = field;
                const size_t bar = name.find('|');
                if (bar != std::string::npos) value = "(" + name.substr(bar + 1) + ")" + value;
                line("%s.%s = %s;", def.c_str(), name.substr(0, bar).c_str(), value.c_str());
            }
}

std::string Source::step_call(double rate) const {
    const std::string dt = "1.0 / " + text_of(rate);
    if (host < 0) return "frond_world_step(world, " + dt + ");";
    return "host.stepSimulation(btScalar(" + dt + "), 0, btScalar(1.0 / 60));";
}

void Source::numbers(const std::string& type, const std::string& name, const std::vector<double>& values,
                     int in_a_line) {
    body += "    static const " + type + " " + name + "[] = {";
    for (size_t i = 0; i < values.size(); i++)
        body += (i ? (i % size_t(in_a_line) ? ", " : ",\n        ") : "") + text_of(values[i]);
    body += "};\n";
}

bool needs_cpp(const Program& program) {
    return whole(program.operations.front(), "host") >= 0;
}

std::string c_source(const Program& program, const std::string& remark) {
    const Source source(program);
    std::string text = "/* " + remark + " */\n";
    if (source.host >= 0) text += host_headers();
    text +=
        "#include <frond/frond_robot.h>\n#include <frond/frond_snapshot.h>\n#include <stdio.h>\n#include <stdlib.h>\n\n"
        "/* The folder models/ of Frond. */\n#ifndef MODELS\n#define MODELS \"models\"\n#endif\n\n"
        "static frond_world world;\n";
    const std::string main_text = "\nint main(void) {\n" + source.body + END;
    return text + helpers_of(main_text) + main_text;
}

}  // namespace frond::programs
