// frond gallery FOLDER: one page with all plant files of a folder, as they are, by organs, in wind and under a ball.
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "commands.hpp"
#include "studio/organ_picture.hpp"

namespace frond::tools {
namespace {

namespace fs = std::filesystem;

struct GalleryOptions {
    std::string folder, out;
    std::vector<std::string> assignments;
    double wind = 5;  // [m/s]
    View view;
};

// What the page says about one file.
struct Entry {
    std::string file, picture;  // path below the folder; file name of the pictures without ending
    std::vector<std::string> figures, doubts;
    std::string error;  // empty: it was loaded
};

// ---- measurements

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...) {
    char text[400];
    va_list words;
    va_start(words, format);
    std::vsnprintf(text, sizeof text, format, words);
    va_end(words);
    return text;
}

std::vector<frond_vec3> positions_of(frond_plant plant) {
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    std::vector<frond_vec3> out;
    for (int i = 0; i < view.vertex_count; i++)
        out.push_back({view.positions[3 * i], view.positions[3 * i + 1], view.positions[3 * i + 2]});
    return out;
}

double gap(const frond_vec3& a, const frond_vec3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

double farthest(const std::vector<frond_vec3>& a, const std::vector<frond_vec3>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, gap(a[i], b[i]));
    return most;
}

// Returns by how much the drawn mesh's edges are stretched most, of those that are not tiny.
double most_stretch(frond_plant plant, const std::vector<frond_vec3>& before, const std::vector<frond_vec3>& now,
                    double size) {
    constexpr double TINY = 0.01;  // share of the plant's size
    frond_surface_view view;
    must(frond_plant_get_surface(plant, &view));
    double most = 1;
    for (int t = 0; t < view.triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const size_t a = size_t(view.indices[3 * t + k]), b = size_t(view.indices[3 * t + (k + 1) % 3]);
            const double length = gap(before[a], before[b]);
            if (length > TINY * size) most = std::max(most, gap(now[a], now[b]) / length);
        }
    return most;
}

void let_pass(Stage& stage, double seconds) {
    for (double time = 0; time < seconds; time += stage.settings.dt)
        must(frond_world_step(stage.world, stage.settings.dt));
}

// ---- pictures

void describe(frond_model model, Entry& entry) {
    constexpr double UNSURE = 0.3;
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    std::map<std::string, int> kinds;
    int unsure = 0;
    for (int i = 0; i < info.organ_count; i++) {
        frond_organ organ;
        must(frond_model_get_organ(model, i, &organ));
        kinds[organ.kind]++;
        unsure += organ.certainty < UNSURE;
    }
    entry.figures.push_back(line("%.3g m high, %.3g kg, %d roots, %d capsules, loaded in %.0f ms",
                                 info.upper.y - info.lower.y, info.mass, info.root_count, info.capsule_count,
                                 info.ms_total));
    std::string organs;
    for (const auto& [kind, count] : kinds) organs += line("%s%d %s", organs.empty() ? "" : ", ", count, kind.c_str());
    entry.figures.push_back(organs);
    if (info.stiffening_factor > 3)
        entry.doubts.push_back(line("made %.3g times stiffer than its materials", info.stiffening_factor));
    if (unsure > 0) entry.doubts.push_back(line("%d organs whose kind is not sure", unsure));
    if (info.lower.y < -0.5 * (info.upper.y - info.lower.y))
        entry.doubts.push_back("most of it is below the file's ground");
}

void show_at_rest(const GalleryOptions& options, const Settings& settings, const std::string& path, Entry& entry) {
    Stage stage(settings);
    const frond_model model = stage.load(path);
    describe(model, entry);
    const frond_plant plant = stage.plant(model, {0, 0, 0});
    Studio studio(options.view);
    studio.shoot(stage);
    studio.write(options.out + "/" + entry.picture + "_rest.png");
    View wide = options.view;
    draw_organs(stage, wide).write(options.out + "/" + entry.picture + "_organs.png");
    const std::vector<frond_vec3> before = positions_of(plant);
    let_pass(stage, 2);
    const double moved = farthest(before, positions_of(plant)) / (stage.upper.y - stage.lower.y);
    if (moved > 0.01) entry.doubts.push_back(line("moves by %.2g of its height while nothing touches it", moved));
}

void show_in_wind(const GalleryOptions& options, Settings settings, const std::string& path, Entry& entry) {
    constexpr double SECONDS = 5, STILL = 1e-3, TORN = 1.3;
    settings.wind.velocity = {options.wind, 0, 0};
    settings.wind.profile = FROND_WIND_PROFILE_UNIFORM;
    Stage stage(settings);
    const frond_plant plant = stage.plant(stage.load(path), {0, 0, 0});
    const std::vector<frond_vec3> before = positions_of(plant);
    let_pass(stage, SECONDS);
    const std::vector<frond_vec3> now = positions_of(plant);
    const double height = stage.upper.y - stage.lower.y, moved = farthest(before, now) / height,
                 stretch = most_stretch(plant, before, now, height);
    Studio studio(options.view);
    studio.shoot(stage);
    studio.write(options.out + "/" + entry.picture + "_wind.png");
    entry.figures.push_back(line("in %g m/s moved by %.2g of its height, edges up to %.2f times their length",
                                 options.wind, moved, stretch));
    if (moved < STILL) entry.doubts.push_back("stands still in wind");
    if (stretch > TORN) entry.doubts.push_back(line("an edge is stretched %.2f times in wind", stretch));
}

void show_under_ball(const GalleryOptions& options, const Settings& settings, const std::string& path, Entry& entry) {
    constexpr double SECONDS = 1, OF_SIZE = 0.07, OF_MASS = 0.1;
    Stage stage(settings);
    const frond_model model = stage.load(path);
    frond_model_info info;
    must(frond_model_get_info(model, &info));
    stage.plant(model, {0, 0, 0});
    frond_rigid_def ball = frond_default_rigid_def();
    ball.shape = FROND_SHAPE_SPHERE;
    ball.size = {
        OF_SIZE * std::hypot(info.upper.x - info.lower.x, info.upper.y - info.lower.y, info.upper.z - info.lower.z), 0,
        0};
    ball.mass = OF_MASS * info.mass;
    ball.state.position = {0.45 * info.lower.x + 0.55 * info.upper.x, info.upper.y + 1.5 * ball.size.x,
                           0.5 * (info.lower.z + info.upper.z)};
    stage.rigid(ball);
    let_pass(stage, SECONDS);
    Studio studio(options.view);
    studio.shoot(stage);
    studio.write(options.out + "/" + entry.picture + "_ball.png");
    frond_report report;
    must(frond_world_get_report(stage.world, &report));
    if (report.trouble & (FROND_TROUBLE_REWOUND | FROND_TROUBLE_NOT_CONVERGED))
        entry.doubts.push_back("the solver had trouble under the ball");
}

// ---- the page

// Returns text for a page, with characters that mean something there replaced.
std::string plain(const std::string& text) {
    std::string out;
    for (char letter : text)
        out += letter == '<'   ? "&lt;"
               : letter == '>' ? "&gt;"
               : letter == '&' ? "&amp;"
               : letter == '"' ? "&quot;"
                               : std::string(1, letter);
    return out;
}

void write_page(const GalleryOptions& options, const std::vector<Entry>& entries) {
    const std::string path = options.out + "/index.html";
    std::ofstream page(path, std::ios::binary);
    size_t doubtful = 0;
    for (const Entry& entry : entries) doubtful += !entry.doubts.empty() || !entry.error.empty();
    page << "<!doctype html><meta charset=\"utf-8\"><title>Frond: plants of " << plain(options.folder) << "</title>\n"
         << "<style>body{font:14px sans-serif;margin:1em}section{border-top:1px solid #ccc;padding:.5em 0}"
            "h2{font-size:1em;margin:.2em 0}img{width:24%}p{margin:.1em "
            "0}.doubt{color:#b02010;font-weight:bold}</style>\n"
         << "<h1>" << entries.size() << " plant files, " << doubtful << " with doubts</h1>\n"
         << "<p>At rest; organs, chain and roots; after 5 s in wind of " << options.wind
         << " m/s; 1 s after a ball was let go above.</p>\n";
    for (const Entry& entry : entries) {
        page << "<section><h2>" << plain(entry.file) << "</h2>\n";
        for (const std::string& figure : entry.figures) page << "<p>" << plain(figure) << "</p>\n";
        for (const std::string& doubt : entry.doubts) page << "<p class=\"doubt\">" << plain(doubt) << "</p>\n";
        if (!entry.error.empty()) page << "<p class=\"doubt\">" << plain(entry.error) << "</p>\n";
        for (const char* what : {"rest", "organs", "wind", "ball"})
            if (fs::exists(options.out + "/" + entry.picture + "_" + what + ".png"))
                page << "<img loading=\"lazy\" alt=\"" << what << "\" src=\"" << entry.picture << "_" << what
                     << ".png\">\n";
        page << "</section>\n";
    }
    page.close();
    if (!page) throw SceneError(path + " cannot be written");
    std::printf("%s: %zu plant files, %zu with doubts\n", path.c_str(), entries.size(), doubtful);
}

std::vector<std::string> list_files(const std::string& folder) {
    static const std::set<std::string> ENDINGS = {".obj", ".ply", ".gltf", ".glb", ".fbx", ".dae", ".stl"};
    std::vector<std::string> files;
    std::error_code failure;
    for (fs::recursive_directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure)) {
        std::string ending = at->path().extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        if (at->is_regular_file() && ENDINGS.count(ending)) files.push_back(at->path().string());
    }
    if (failure) throw SceneError("the folder " + folder + " cannot be read: " + failure.message());
    if (files.empty())
        throw SceneError("the folder " + folder + " has no plant file: .obj .ply .gltf .glb .fbx .dae .stl");
    std::sort(files.begin(), files.end());
    return files;
}

void show_gallery(const GalleryOptions& options) {
    const std::vector<std::string> files = list_files(options.folder);
    std::error_code failure;
    fs::create_directories(options.out, failure);
    if (failure) throw SceneError("the folder " + options.out + " cannot be made: " + failure.message());
    Settings settings;
    settings.model.allow_stiffening = INFINITY;  // what is too weak is marked
    for (const std::string& assignment : options.assignments) apply_setting(settings, assignment);
    std::vector<Entry> entries;
    Progress progress("file", int(files.size()));
    for (const std::string& path : files) {
        Entry entry;
        entry.file = fs::path(path).lexically_relative(options.folder).generic_string();
        entry.picture = line("%03zu", entries.size());
        try {
            show_at_rest(options, settings, path, entry);
            show_in_wind(options, settings, path, entry);
            show_under_ball(options, settings, path, entry);
        } catch (const SceneError& error) {
            entry.error = error.what();
        }
        entries.push_back(entry);
        progress.at(int(entries.size()));
    }
    write_page(options, entries);
}

}  // namespace

void add_gallery(CLI::App& app) {
    auto options = std::make_shared<GalleryOptions>();
    options->view.width = 480;
    options->view.height = 400;
    CLI::App* command = app.add_subcommand("gallery", "a page with all plant files of a folder and what is doubtful");
    command->add_option("folder", options->folder, "folder with plant files, and folders in it")->required();
    command->add_option("--out", options->out, "folder for the page, made if it is not there")->required();
    command->add_option("--wind", options->wind, "speed of the wind [m/s]")->check(real_in(0, 100));
    command->add_option("--set", options->assignments, "key=value, may be repeated; see frond run --help");
    command->callback([options] { show_gallery(*options); });
}

}  // namespace frond::tools
