// frond export SCENE|FILE: steps a scene and writes the result for other programs: the surface as a mesh file, its
// motion as morph targets or a vertex cache, states as a table, the plant as URDF.
#include "export.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

#include "commands.hpp"

namespace frond::tools {
namespace {

struct ExportOptions {
    std::string what, out, animation, csv, cache, urdf;
    double at = 0;  // time at which the mesh is written [s]
    int every = 2;  // steps between samples of the animation
    std::vector<std::string> assignments;
};

// ---- records of the motion ------------------------------------------------------------------------------------------

// Vertices of all plants, a sample per step, as a point cache that Blender and Maya apply to the mesh of the first one:
// PC2, little-endian.
class PointCache {
public:
    PointCache(const std::string& path, double rate) : path(path), rate(float(rate)), file(open_to_write(path, true)) {
        write_head(0, 0);
    }
    void add(const Stage& stage) {
        int count = 0;
        for (frond_plant plant : stage.plants) {
            frond_surface_view view;
            must(frond_plant_get_surface(plant, &view));
            file.write(reinterpret_cast<const char*>(view.positions), std::streamsize(12) * view.vertex_count);
            count += view.vertex_count;
        }
        samples++;
        points = count;
    }
    void finish() {
        file.seekp(0);
        write_head(points, samples);
        close(file, path);
    }

private:
    void write_head(int32_t point_count, int32_t sample_count) {
        const int32_t version = 1;
        const float start = 0;
        file.write("POINTCACHE2\0", 12);
        file.write(reinterpret_cast<const char*>(&version), 4);
        file.write(reinterpret_cast<const char*>(&point_count), 4);
        file.write(reinterpret_cast<const char*>(&start), 4);
        file.write(reinterpret_cast<const char*>(&rate), 4);
        file.write(reinterpret_cast<const char*>(&sample_count), 4);
    }
    std::string path;
    float rate;  // samples per frame of 1/24 s
    std::ofstream file;
    int32_t points = 0, samples = 0;
};

// A line for each step and plant: time, tip, force and moment of the ground, energies, contacts.
class Table {
public:
    explicit Table(const std::string& path) : path(path), file(open_to_write(path)) {
        file << "time,plant,tip_x,tip_y,tip_z,root_force_x,root_force_y,root_force_z,root_moment_x,root_moment_y,"
                "root_moment_z,kinetic,elastic,gravity,contacts\n";
    }
    void add(const Stage& stage) {
        for (size_t i = 0; i < stage.plants.size(); i++) {
            frond_vec3 tip, force, moment;
            frond_energy energy;
            must(frond_plant_get_tip(stage.plants[i], &tip));
            must(frond_plant_get_root_force(stage.plants[i], stage.places[i], &force, &moment));
            must(frond_plant_get_energy(stage.plants[i], &energy));
            char line[512];
            std::snprintf(line, sizeof line,
                          "%.9g,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n", stage.time, i,
                          tip.x, tip.y, tip.z, force.x, force.y, force.z, moment.x, moment.y, moment.z, energy.kinetic,
                          energy.elastic, energy.gravity, frond_plant_get_contact_count(stage.plants[i]));
            file << line;
        }
    }
    void finish() { close(file, path); }

private:
    std::string path;
    std::ofstream file;
};

void run(const ExportOptions& options) {
    if (options.out.empty() && options.animation.empty() && options.csv.empty() && options.cache.empty() &&
        options.urdf.empty())
        throw SceneError("nothing to write; name a file with --out, --animation, --cache, --csv or --urdf");
    for (const std::string& path : {options.out, options.animation})
        if (!path.empty()) check_mesh_ending(path);
    const Casting casting = cast(options.what);
    const Settings settings = settings_of(casting, options.assignments);
    Play play(casting, settings);
    std::unique_ptr<Table> table;
    std::unique_ptr<PointCache> cache;
    if (!options.csv.empty()) table = std::make_unique<Table>(options.csv);
    if (!options.cache.empty()) cache = std::make_unique<PointCache>(options.cache, 1 / (24 * settings.dt));
    std::vector<Sample> samples;
    const auto note = [&](long step) {
        if (table) table->add(play.stage);
        if (cache) cache->add(play.stage);
        if (!options.animation.empty() && step % options.every == 0) samples.push_back(sample_of(play.stage));
    };
    note(0);
    for (long i = 1; i <= std::lround(options.at / settings.dt); i++) {
        play.step();
        note(i);
    }
    if (table) table->finish();
    if (cache) cache->finish();
    if (!options.out.empty()) write_mesh(options.out, play.stage);
    if (!options.animation.empty()) write_animation(options.animation, play.stage, samples);
    if (!options.urdf.empty()) must(frond_model_write_urdf(play.stage.plant_models[0], options.urdf.c_str()));
}

}  // namespace

void add_export(CLI::App& app) {
    auto options = std::make_shared<ExportOptions>();
    CLI::App* command = app.add_subcommand("export", "write what becomes of a scene or plant file, for other programs");
    command->add_option("what", options->what, "a mesh file, or a scene as for run")->required();
    command->add_option("--out", options->out, "surface of all plants: .gltf .glb .obj .ply");
    command->add_option("--at", options->at, "when [s], default 0")->check(real_in(0, 1e6));
    command->add_option("--animation", options->animation, "the way until then, as morph targets: .gltf .glb");
    command->add_option("--every", options->every, "steps from target to target, default 2")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--cache", options->cache, "places of all vertices at each step until then: .pc2")
        ->check(file_ending_in(".pc2"));
    command->add_option("--csv", options->csv, "tip, forces at the root, energies at each step until then");
    command->add_option("--urdf", options->urdf, "the first plant as it was modelled, as links and joints: .urdf")
        ->check(file_ending_in(".urdf"));
    command->add_option("--set", options->assignments, "key=value, may be repeated");
    command->footer("Keys of --set:\n" + settings_help());
    command->callback([options] { run(*options); });
}

}  // namespace frond::tools
