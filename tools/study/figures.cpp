#include "study/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "studio/studio.hpp"
#include "study/plants.hpp"
#include "study/report.hpp"

namespace frond::study {
namespace {

// Returns the paper's mechanics, if the library has it, else the default.
frond_mechanics paper_mechanics() {
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++)
        if (std::strcmp(frond_mechanics_name(frond_mechanics(m)), "spring_chain") == 0) return frond_mechanics(m);
    return frond_default_plant_def().mechanics;
}

std::string centimetres(double metres) {
    std::ostringstream out;
    out << std::lround(100 * metres) << " cm";
    return out.str();
}

// Returns the chain's nodes from the root to the highest one.
std::vector<int> main_axis(const frond_chain_view& chain) {
    int at = 0;
    for (int i = 1; i < chain.node_count; i++)
        if (chain.nodes[3 * i + 1] > chain.nodes[3 * at + 1]) at = i;
    std::vector<int> axis;
    for (; at >= 0; at = chain.parents[at]) axis.push_back(at);
    std::reverse(axis.begin(), axis.end());
    return axis;
}

// Returns how far the axis moved from where it was drawn, over its height there. Each node but a root ends a capsule,
// and capsules are in the order of the nodes.
Curve droop_curve(frond_plant plant, frond_model model) {
    frond_chain_view chain;
    must(frond_model_get_chain(model, &chain));
    std::vector<int> capsule_of(size_t(chain.node_count), -1);
    int count = 0;
    for (int i = 0; i < chain.node_count; i++)
        if (chain.parents[i] >= 0) capsule_of[size_t(i)] = count++;
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(plant)));
    must(frond_plant_get_capsules(plant, capsules.data(), int(capsules.size())));
    Curve curve;
    for (int node : main_axis(chain)) {
        if (capsule_of[size_t(node)] < 0) continue;
        const frond_vec3& now = capsules[size_t(capsule_of[size_t(node)])].end;
        const double* drawn = chain.nodes + 3 * node;
        curve.x.push_back(drawn[1]);
        curve.y.push_back(std::hypot(std::hypot(now.x - drawn[0], now.y - drawn[1]), now.z - drawn[2]));
    }
    return curve;
}

tools::View view_of(std::vector<std::string> overlays) {
    tools::View view;
    view.width = 480;
    view.height = 640;
    view.overlays = std::move(overlays);
    return view;
}

// ---- Fig 6 -------------------------------------------------------------------------------------------------------

FigurePanel stand_panel(const std::string& folder, double h) {
    tools::Settings settings;
    settings.model.rest = FROND_REST_WITHOUT_GRAVITY;
    settings.model.cage_size = tools::PAPER_CUCUMBER_CELL;
    settings.model.capsule_height = h;
    settings.plant.mechanics = paper_mechanics();

    const ModelPtr model = load_plant(CUCUMBER, settings.model);
    Setup setup;
    setup.body = Body::PLANT;
    setup.plant = settings.plant;
    const std::unique_ptr<Trial> rests = settle(model, setup, 8, [](Trial& trial, double share) {
        trial.set_gravity({0, -9.81 * share, 0});
    });

    tools::Stage stage(settings);
    stage.plant(model->handle, {0, 0, 0});
    const Trial::State state = rests->state();
    must(frond_plant_set_state(stage.plants[0], state.x.data(), state.v.data(), int(state.x.size() / 3)));
    tools::Studio studio(view_of({"capsules"}));
    studio.shoot(stage);
    FigurePanel panel;
    panel.picture = "fig6_h" + std::to_string(std::lround(100 * h)) + ".png";
    studio.write(folder + "/" + panel.picture);
    panel.caption = "h = " + centimetres(h);
    panel.curve = droop_curve(rests->plant, model->handle);
    panel.curve.name = panel.caption;
    const double most = *std::max_element(panel.curve.y.begin(), panel.curve.y.end());
    Trial trial(model, setup);
    trial.start_from(*rests);
    trial.set_gravity({0, -9.81, 0});
    const double cpu = time_steps(trial, Effort::QUICK, [](Trial&, double) {});
    panel.row = {h, double(model->info().capsule_count), most, 1e3 * cpu * setup.dt};
    return panel;
}

Figure make_fig6(const std::string& folder, Effort) {
    Figure figure = {"fig6",
                     "the cucumber's natural stand under gravity, its mesh being the shape without it and its stem as "
                     "firm as with a string",
                     "height of the axis as drawn [m]",
                     "moved by gravity [m]",
                     "",
                     {"h [m]", "capsules", "axis moved at most [m]", "CPU ms a step of 1/60 s"},
                     {}};
    for (double h : {0.20, 0.10, 0.05, 0.03}) figure.panels.push_back(stand_panel(folder, h));
    return figure;
}

// ---- Fig 7 -------------------------------------------------------------------------------------------------------

FigurePanel drag_panel(const std::string& folder, double r) {
    constexpr double PULLED_FROM = 0.6, SHOT_AT = 1.9;  // [s]; the hand lets go at 2 s
    constexpr double HAND = 2000;                       // stiffness of the hand's spring [N/m]
    const tools::Casting casting = tools::cast("cucumber_drag");
    tools::Settings settings = tools::settings_of(casting, {});
    settings.grab_stiffness = HAND;
    settings.model.capsule_height = 0.20;
    settings.model.capsule_radius = r;
    settings.plant.mechanics = paper_mechanics();
    tools::Play play(casting, settings);
    FigurePanel panel;
    panel.picture = "fig7_r" + std::to_string(std::lround(100 * r)) + ".png";
    panel.caption = panel.curve.name = "r = " + centimetres(r);
    while (play.stage.time < SHOT_AT) {
        play.step();
        if (play.stage.grabs.empty() || play.stage.time < PULLED_FROM) continue;
        frond_vec3 at, force;
        must(frond_grab_get(play.stage.grabs[0], &at, nullptr, &force));
        const frond_vec3& from = play.stage.drag_start;
        panel.curve.x.push_back(std::hypot(std::hypot(at.x - from.x, at.y - from.y), at.z - from.z));
        panel.curve.y.push_back(std::hypot(std::hypot(force.x, force.y), force.z));
    }
    tools::Studio studio(view_of({"capsules", "force"}));
    studio.shoot(play.stage);
    studio.write(folder + "/" + panel.picture);
    frond_model_info info;
    must(frond_model_get_info(play.stage.plant_models[0], &info));
    panel.row = {r, double(info.capsule_count), panel.curve.x.back(), panel.curve.y.back()};
    return panel;
}

Figure make_fig7(const std::string& folder, Effort) {
    Figure figure = {"fig7",
                     "the cucumber dragged by its user, h = 20 cm; the drag force is the red line",
                     "way of the point that is held [m]",
                     "drag force [N]",
                     "xy",
                     {"r [m]", "capsules", "point moved [m]", "force [N]"},
                     {}};
    for (double r : {0.25, 0.10, 0.05}) figure.panels.push_back(drag_panel(folder, r));
    return figure;
}

}  // namespace

const std::vector<FigureRow>& figures() {
    static const std::vector<FigureRow> table = {
        {"fig6", "the paper's Fig 6: the cucumber's natural stand for four capsule heights", make_fig6},
        {"fig7", "the paper's Fig 7: the cucumber dragged, for three capsule radii", make_fig7},
        {"contact", "two corn plants that stand in each other: what is left of that over time, and what it costs",
         make_contact},
    };
    return table;
}

std::string csv_of(const Figure& figure) {
    std::ostringstream out;
    out << "# " << figure.name << ": " << figure.shows << "\nseries," << csv_field(figure.x_label) << ','
        << csv_field(figure.y_label) << '\n';
    for (const FigurePanel& panel : figure.panels)
        for (size_t i = 0; i < panel.curve.x.size(); i++)
            out << csv_field(panel.curve.name) << ',' << panel.curve.x[i] << ',' << panel.curve.y[i] << '\n';
    return out.str();
}

std::string markdown_of(const Figure& figure) {
    std::ostringstream out;
    std::string pictures = "|", rule = "|", captions = "|";
    for (const FigurePanel& panel : figure.panels) {
        if (panel.picture.empty()) continue;
        pictures += " ![" + panel.caption + "](" + panel.picture + ") |";
        captions += " " + panel.caption + " |";
        rule += "---|";
    }
    out << "## " << figure.name << "\n\n" << figure.shows << ".\n\n";
    if (rule.size() > 1) out << captions << "\n" << rule << "\n" << pictures << "\n\n";
    out << "![" << figure.name << "](" << figure.name << ".svg)\n\n|";
    for (const std::string& column : figure.columns) out << ' ' << markdown_cell(column) << " |";
    out << "\n|";
    for (size_t i = 0; i < figure.columns.size(); i++) out << "---|";
    out << "\n";
    for (const FigurePanel& panel : figure.panels) {
        out << '|';
        if (figure.columns.size() > panel.row.size()) out << ' ' << markdown_cell(panel.caption) << " |";
        for (double value : panel.row) out << ' ' << std::lround(value * 1000) / 1000.0 << " |";
        out << "\n";
    }
    return out.str();
}

std::string gnuplot_of(const Figure& figure, const std::string& picture_base) {
    constexpr size_t MARKED = 100;  // largest number of points with marks
    std::ostringstream out, plot;
    out << "set encoding utf8\nset xlabel " << gnuplot_text(figure.x_label) << "\nset ylabel "
        << gnuplot_text(figure.y_label) << "\nset tics nomirror\nset border 3\nset grid lc rgb '#dddddd' lw 0.5\n"
        << "set key outside right top Left reverse noenhanced\n";
    if (*figure.logarithmic)
        out << "set logscale " << figure.logarithmic << "\nset format " << figure.logarithmic << " '10^{%T}'\n";
    static constexpr const char* COLOURS[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                              "#E69F00", "#56B4E9", "#000000"};
    int drawn = 0;
    for (const FigurePanel& panel : figure.panels) {
        const Curve& curve = panel.curve;
        if (curve.x.empty()) continue;
        const int i = drawn++;
        out << "$c" << i << " << EOD\n";
        for (size_t k = 0; k < curve.x.size(); k++) out << curve.x[k] << ' ' << curve.y[k] << '\n';
        out << "EOD\n";
        plot << (i ? ", " : "plot ") << "$c" << i << " using 1:2 with ";
        if (curve.x.size() > MARKED)
            plot << "lines";
        else
            plot << "linespoints pt 7 ps 0.6";
        plot << " lw 2 dt " << 1 + i / 7 << " lc rgb '" << COLOURS[i % 7] << "' title " << gnuplot_text(curve.name);
    }
    out << drawn_twice(plot.str(), picture_base);
    return out.str();
}

}  // namespace frond::study
