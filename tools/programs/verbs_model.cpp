// Operations that make models: from files, stems, tets and triangles.
#include <algorithm>
#include <cmath>

#include "programs/run.hpp"
#include "programs/source.hpp"
#include "scenes/lattice.hpp"

namespace frond::programs {

namespace {

using tools::Lattice;

constexpr const char* FILES[] = {"corn/corn.obj",         "wheat/wheat.obj",   "sunflower/sunflower.obj",
                                 "cucumber/cucumber.obj", "urdf/sapling.urdf", "urdf/seedling.urdf"};
constexpr int FILE_COUNT = sizeof FILES / sizeof *FILES;

// Models of files take long to make, and are the same in all programs.
frond_model file_model(int file, double cage_size) {
    static std::map<std::pair<int, double>, frond_model> made;
    frond_model& model = made[{file, cage_size}];
    if (frond_model_is_valid(model)) return model;
    frond_model_def def = frond_default_model_def();
    def.cage_size = cage_size;
    frond_model_load(tools::model_path(FILES[file]).c_str(), &def, &model);
    return model;
}

void load(Run& run, const Operation& o) {
    const frond_model model = file_model(whole(o, "file"), number(o, "cage_size"));
    if (frond_model_is_valid(model)) run.add_shared_model(o.id, model);
}
void write_load(Source& s, const Operation& o) {
    s.line("frond_model_def model_def_%d = frond_default_model_def();", o.id);
    s.fields("model_def_" + std::to_string(o.id), o, {{"cage_size", "cage_size"}});
    s.line("frond_model model_%d = {0};", o.id);
    s.line("frond_model_load(MODELS \"/%s\", &model_def_%d, &model_%d);", FILES[whole(o, "file")], o.id, o.id);
}

// A stem in pieces that lean more and more, with branches to the sides, as far up as there are.
std::vector<frond_stem> stems_of(const Operation& o) {
    const int pieces = whole(o, "pieces"), branches = whole(o, "branches");
    const double height = number(o, "height"), radius = number(o, "radius"), lean = number(o, "lean");
    std::vector<frond_stem> stems;
    const auto at = [&](double share) { return frond_vec3{lean * height * share * share, height * share, 0}; };
    for (int i = 0; i < pieces; i++) {
        const double low = double(i) / pieces, high = double(i + 1) / pieces;
        stems.push_back({i - 1, at(low), at(high), radius * (1 - 0.6 * low), radius * (1 - 0.6 * high)});
    }
    for (int i = 0; i < branches; i++) {
        const int parent = i % pieces;
        const double turn = 2.4 * i, length = height * number(o, "spread");
        const frond_vec3 from = stems[size_t(parent)].end;
        const double thin = 0.5 * stems[size_t(parent)].radius_end;
        stems.push_back({parent,
                         from,
                         {from.x + length * std::cos(turn), from.y + 0.3 * length, from.z + length * std::sin(turn)},
                         thin,
                         0.6 * thin});
    }
    return stems;
}
void grow(Run& run, const Operation& o) {
    const std::vector<frond_stem> stems = stems_of(o);
    frond_model_def def = frond_default_model_def();
    def.rest = frond_rest(whole(o, "rest"));
    frond_model model = {};
    if (run.check(frond_model_from_stems(stems.data(), int(stems.size()), &def, &model)))
        run.add_model(o.id, model, def.rest == FROND_REST_STANDS_AS_MODELLED);
}
void write_grow(Source& s, const Operation& o) {
    const std::vector<frond_stem> stems = stems_of(o);
    const int id = o.id;
    s.line("static const frond_stem stems_%d[] = {", id);
    for (const frond_stem& stem : stems)
        s.line("    {%d, {%s}, {%s}, %s, %s},", stem.parent, vec_text(stem.begin).c_str(), vec_text(stem.end).c_str(),
               text_of(stem.radius_begin).c_str(), text_of(stem.radius_end).c_str());
    s.line("};");
    s.line("frond_model_def model_def_%d = frond_default_model_def();", id);
    s.fields("model_def_" + std::to_string(id), o, {{"rest|frond_rest", "rest"}});
    s.line("frond_model model_%d = {0};", id);
    s.line("frond_model_from_stems(stems_%d, %d, &model_def_%d, &model_%d);", id, int(stems.size()), id, id);
}

Lattice lattice_of(const Operation& o) {
    return tools::make_lattice(number(o, "width"), whole(o, "across"),
                               tools::even_heights(number(o, "height"), whole(o, "layers")));
}
frond_material material_of(const Operation& o) {
    frond_material material = frond_default_material();
    material.young = number(o, "young");
    material.poisson = number(o, "poisson");
    material.yield_strain = number(o, "yield_strain");
    return material;
}
void pile(Run& run, const Operation& o) {
    const Lattice lattice = lattice_of(o);
    const frond_organ_material organ = {"stem", material_of(o)};
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    def.organs = &organ;
    def.organ_count = 1;
    frond_model model = {};
    if (run.check(frond_model_from_tets(lattice.nodes.data(), int(lattice.nodes.size() / 3), lattice.tets.data(),
                                        int(lattice.tets.size() / 4), &def, &model)))
        run.add_model(o.id, model, false);
}
void write_pile(Source& s, const Operation& o) {
    const Lattice lattice = lattice_of(o);
    const std::string id = std::to_string(o.id);
    s.numbers("double", "nodes_" + id, lattice.nodes, 9);
    s.numbers("int32_t", "tets_" + id, std::vector<double>(lattice.tets.begin(), lattice.tets.end()), 20);
    s.line("frond_organ_material organ_%d = {\"stem\", frond_default_material()};", o.id);
    const frond_material material = material_of(o);
    s.line("organ_%d.material.young = %s, organ_%d.material.poisson = %s, organ_%d.material.yield_strain = %s;", o.id,
           text_of(material.young).c_str(), o.id, text_of(material.poisson).c_str(), o.id,
           text_of(material.yield_strain).c_str());
    s.line("frond_model_def model_def_%d = frond_default_model_def();", o.id);
    s.line("model_def_%d.scale = model_def_%d.up.y = 1;", o.id, o.id);
    s.line("model_def_%d.organs = &organ_%d, model_def_%d.organ_count = 1;", o.id, o.id, o.id);
    s.line("frond_model model_%d = {0};", o.id);
    s.line("frond_model_from_tets(nodes_%d, %d, tets_%d, %d, &model_def_%d, &model_%d);", o.id,
           int(lattice.nodes.size() / 3), o.id, int(lattice.tets.size() / 4), o.id, o.id);
}

// A stem of triangles, three sides that do not share vertices, and blades of single triangles that stick in it.
struct Soup {
    std::vector<float> xyz;
    std::vector<int32_t> indices;
};
Soup soup_of(const Operation& o) {
    const double height = number(o, "height"), radius = number(o, "radius"), blade = number(o, "blade") * height;
    const int layers = whole(o, "layers"), blades = whole(o, "blades");
    Soup soup;
    const auto add = [&](double x, double y, double z) {
        soup.indices.push_back(int32_t(soup.xyz.size() / 3));
        for (double value : {x, y, z}) soup.xyz.push_back(float(value));
    };
    const auto rim = [&](int layer, int side) {
        const double turn = 2.0944 * side;
        add(radius * std::cos(turn), height * layer / layers, radius * std::sin(turn));
    };
    for (int layer = 0; layer < layers; layer++)
        for (int side = 0; side < 3; side++) {
            rim(layer, side), rim(layer + 1, side), rim(layer, side + 1);
            rim(layer, side + 1), rim(layer + 1, side), rim(layer + 1, side + 1);
        }
    for (int i = 0; i < blades; i++) {
        const double turn = 2.4 * i, y = height * (i + 1) / (blades + 1), wide = 0.15 * blade;
        const double c = std::cos(turn), s = std::sin(turn);
        add(-wide * s, y, wide * c), add(wide * s, y, -wide * c), add(blade * c, y + 0.3 * blade, blade * s);
    }
    return soup;
}
void pour(Run& run, const Operation& o) {
    const Soup soup = soup_of(o);
    frond_model_def def = frond_default_model_def();
    def.scale = 1;
    def.up = {0, 1, 0};
    frond_model model = {};
    if (run.check(frond_model_from_triangles(soup.xyz.data(), int(soup.xyz.size() / 3), soup.indices.data(),
                                             int(soup.indices.size() / 3), &def, &model)))
        run.add_model(o.id, model, true);
}
void write_pour(Source& s, const Operation& o) {
    const Soup soup = soup_of(o);
    const std::string id = std::to_string(o.id);
    s.numbers("float", "xyz_" + id, std::vector<double>(soup.xyz.begin(), soup.xyz.end()), 9);
    s.numbers("int32_t", "indices_" + id, std::vector<double>(soup.indices.begin(), soup.indices.end()), 24);
    s.line("frond_model_def model_def_%d = frond_default_model_def();", o.id);
    s.line("model_def_%d.scale = model_def_%d.up.y = 1;", o.id, o.id);
    s.line("frond_model model_%d = {0};", o.id);
    s.line("frond_model_from_triangles(xyz_%d, %d, indices_%d, %d, &model_def_%d, &model_%d);", o.id,
           int(soup.xyz.size() / 3), o.id, int(soup.indices.size() / 3), o.id, o.id);
}

}  // namespace

std::vector<Verb> model_verbs() {
    constexpr Kind NONE = Kind::NONE, MODEL = Kind::MODEL;
    constexpr Scale LOG = Scale::LOG, WHOLE = Scale::WHOLE;
    return {
        {"model",
         MODEL,
         {NONE, NONE},
         1,
         {{"file", 0, 0, FILE_COUNT - 1, 0.85, WHOLE}, {"cage_size", 0, 0.15, 0.3, 0}},
         load,
         write_load},
        {"stems",
         MODEL,
         {NONE, NONE},
         1,
         {{"pieces", 2, 1, 5, 0.7, WHOLE},
          {"branches", 1, 0, 6, 0.7, WHOLE},
          {"height", 0.6, 0.1, 3, 0.7, LOG},
          {"radius", 0.01, 0.002, 0.03, 0.7, LOG},
          {"lean", 0, -0.5, 0.5, 0.4},
          {"spread", 0.3, 0.1, 0.6, 0.5},
          {"rest", FROND_REST_STANDS_AS_MODELLED, 0, FROND_REST_COUNT - 1, 0.3, WHOLE}},
         grow,
         write_grow},
        {"tets",
         MODEL,
         {NONE, NONE},
         1,
         {{"width", 0.1, 0.02, 0.2, 0.6, LOG},
          {"across", 1, 1, 2, 0.4, WHOLE},
          {"height", 1, 0.3, 2, 0.6, LOG},
          {"layers", 6, 3, 12, 0.6, WHOLE},
          {"young", 1e7, 1e6, 1e9, 0.5, LOG},
          {"poisson", 0.3, 0, 0.49, 0.3},
          {"yield_strain", 0, 0.005, 0.1, 0.3, LOG}},
         pile,
         write_pile},
        {"soup",
         MODEL,
         {NONE, NONE},
         1,
         {{"height", 0.5, 0.1, 2, 0.7, LOG},
          {"radius", 0.01, 0.003, 0.03, 0.6, LOG},
          {"blade", 0.4, 0.1, 0.8, 0.6},
          {"layers", 4, 1, 8, 0.5, WHOLE},
          {"blades", 2, 0, 6, 0.6, WHOLE}},
         pour,
         write_pour},
    };
}

}  // namespace frond::programs
