// frond bench versus-bullet: compares Frond with Bullet's own soft bodies: same tets, same material, same load.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include "bench.hpp"
#include "quantile.hpp"
#include "stability/bullet_beam.hpp"
#include "study/report.hpp"

namespace frond::tools {

namespace {

using stability::BulletBeam;
using stability::BulletMethod;
using stability::FOOT;
using stability::Lattice;
using stability::Places;

// The body stands upright as modelled, without weight, and is then pulled sideways, undamped, for a second.
constexpr frond_vec3 PULL = {3, 0, 0};  // [m/s^2]
constexpr int FRAMES = 60;              // per second
constexpr int FINE = 16;                // steps per frame of the reference motion that errors are measured against
const char* const NO_END = "no end";    // within the time limit of a run

// Beams 1 m long of 200, 1,600 and 20,480 tets: cells across and along. Cages of plants may overlap, tets from the
// caller may not.
constexpr int BODIES[][2] = {{2, 10}, {4, 20}, {8, 64}};

// Position of the top after each frame, and time of a frame.
struct Run {
    Places top;
    double frame = 0;  // median [s]
};

Run run(const std::function<void()>& frame, const std::function<frond_vec3()>& top) {
    Run made;
    std::vector<double> seconds;
    for (int i = 0; i < FRAMES; i++) {
        const auto start = std::chrono::steady_clock::now();
        frame();
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        made.top.push_back(top());
    }
    made.frame = median(seconds);
    return made;
}

Run run_frond(const Lattice& lattice, frond_mechanics mechanics, int steps) {
    const frond_model model = stability::model_of(lattice, stability::plain_material());
    frond_world_def world_def = frond_default_world_def();
    world_def.gravity = PULL;
    world_def.sleep_distance = 0;
    world_def.max_substep = 1.0 / (FRAMES * steps);
    frond_world world = {};
    must(frond_world_create(&world_def, &world));
    frond_plant_def def = frond_default_plant_def();
    def.mechanics = mechanics;
    def.root_height = FOOT;
    def.mass_damping = def.stiffness_damping = def.material_damping = 0;
    frond_plant plant = {};
    must(frond_plant_create(world, model, &def, &plant));
    size_t top = 0;
    for (size_t i = 0; 3 * i < lattice.nodes.size(); i++)
        if (lattice.nodes[3 * i + 1] > lattice.nodes[3 * top + 1]) top = i;
    const int nodes = frond_plant_get_node_count(plant);
    Places x(size_t(nodes), frond_vec3{});
    const Run made = run(
        [&] {
            for (int i = 0; i < steps; i++) must(frond_world_step(world, world_def.max_substep));
        },
        [&] {
            must(frond_plant_get_state(plant, &x[0].x, nullptr, nodes));
            return x[top];
        });
    frond_world_destroy(world);
    frond_model_destroy(model);
    return made;
}

Run run_bullet(const Lattice& lattice, BulletMethod method, int steps) {
    BulletBeam body(method, 1.0 / (FRAMES * steps), lattice, stability::plain_material());
    body.set_gravity(PULL);
    return run([&] { body.run(1.0 / FRAMES); }, [&] { return body.place(body.top); });
}

// Returns the RMS distance of the top from its reference position, relative to its RMS displacement.
double error_of(const Run& made, const Run& exact) {
    double error = 0, way = 0;
    const frond_vec3 start = exact.top.front();
    for (size_t i = 0; i < made.top.size(); i++) {
        error += std::pow(length(made.top[i] - exact.top[i]), 2);
        way += std::pow(length(exact.top[i] - start), 2);
    }
    return std::sqrt(error / way);
}

// Measures in a separate process, as Bullet's world may never return from a step: time of a frame and, as text, the
// error.
stability::Verdict measure(const std::function<Run()>& make, const Run& exact) {
    const stability::Limits limits = {20, 1};
    const auto job = [&](size_t) {
        stability::Verdict verdict;
        try {
            const Run made = make();
            char text[20];
            std::snprintf(text, sizeof text, "%.2g", error_of(made, exact));
            verdict = {stability::Color::GREEN, text, 0, made.frame};
        } catch (const stability::Broken&) {
            verdict.text = "blows up";
        }
        return verdict;
    };
    stability::Verdict verdict = stability::run_apart(1, limits, job, [](int) {}).front();
    if (verdict.color != stability::Color::GREEN && verdict.text != "blows up") verdict.text = NO_END;
    return verdict;
}

void print_row(int tets, const char* program, const char* method, int steps, const stability::Verdict& verdict,
               bool csv) {
    const double ms = 1e3 * verdict.seconds;
    if (csv)
        std::printf("%d,%s,%s,%d,%.4f,%s,%s,%s,%s,%s\n", tets, program, method, FRAMES * steps, ms,
                    verdict.text.c_str(), study::csv_field(study::processor_name()).c_str(),
                    study::csv_field(FROND_COMPILER).c_str(), frond_version_string(), FROND_COMMIT);
    else
        std::printf("%7d %-7s %-16s %5s%-4d %10.3f %9s\n", tets, program, method, "1/", FRAMES * steps, ms,
                    verdict.text.c_str());
    std::fflush(stdout);
}

}  // namespace

void bench_versus_bullet(const BenchOptions& options) {
    constexpr frond_mechanics FROND_ROWS[] = {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN};
    if (options.csv)
        std::printf("tets,program,method,steps_a_second,frame_ms,error,processor,compiler,version,commit\n");
    else
        std::printf(
            "a second of a body that is held at its foot and pulled sideways, by steps [s]: what 1/60 s takes [ms, "
            "median], one "
            "core, and how far the top is from\nwhere steps of 1/%d s have it, over its way\n%s, %s, frond %s %s\n"
            "%7s %-7s %-16s %9s %10s %9s\n",
            FRAMES * FINE, study::processor_name().c_str(), FROND_COMPILER, frond_version_string(), FROND_COMMIT,
            "tets", "program", "method", "step", "frame", "error");
    // A method that once failed to finish in time will not finish with more tets or shorter steps.
    std::array<bool, size_t(BulletMethod::COUNT)> ends;
    ends.fill(true);
    for (const auto& [across, along] : BODIES) {
        const Lattice lattice = make_lattice(0.1, across, even_heights(1, along));
        if (int(lattice.tets.size() / 4) > options.most) continue;
        const int tets = int(lattice.tets.size() / 4);
        const Run exact = run_frond(lattice, FROND_MECHANICS_TET_NEOHOOKEAN, FINE);
        for (const int steps : {1, 4}) {
            for (const frond_mechanics mechanics : FROND_ROWS)
                print_row(tets, "frond", frond_mechanics_name(mechanics), steps,
                          measure([&] { return run_frond(lattice, mechanics, steps); }, exact), options.csv);
            for (size_t m = 0; m < ends.size(); m++) {
                if (!ends[m]) continue;
                const stability::Verdict verdict =
                    measure([&] { return run_bullet(lattice, BulletMethod(m), steps); }, exact);
                ends[m] = verdict.text != NO_END;
                print_row(tets, "bullet", name_of(BulletMethod(m)), steps, verdict, options.csv);
            }
        }
    }
}

}  // namespace frond::tools
