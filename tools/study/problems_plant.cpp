// Whole plants, for which no solution is known: how they stand, drift, resist a pull and vibrate, each compared with a
// reference that is refined until it no longer changes, in space for statics and in time for motion.
#include <cmath>
#include <cstring>

#include "study/path.hpp"
#include "study/plants.hpp"
#include "study/problems.hpp"

namespace frond::study {

const PlantCase CORN = {"corn", "corn/corn.obj", {}};
// Its thin stem carries it only with the growers' string, whose stiffness is included in its modulus.
const PlantCase CUCUMBER = {"cucumber", "cucumber/cucumber.obj", {"material.stem.young=1e10"}};

ModelPtr load_plant(const PlantCase& plant, frond_model_def def) {
    tools::Settings settings;
    settings.model = def;
    for (const std::string& assignment : plant.materials) tools::apply_setting(settings, assignment);
    auto stage = std::make_shared<tools::Stage>(settings);
    const frond_model handle = stage->load(tools::model_path(plant.file));
    stage->models.clear();  // ownership of the model passes from the stage to us
    return std::make_shared<const Model>(handle);
}

ModelPtr plant_model(const PlantCase& plant, const Setup& setup, frond_rest rest, Session& session) {
    const bool chain = moves_chain(setup.plant.mechanics);
    const std::string key = std::string(plant.name) + (chain ? " chain " : " cage ") +
                            std::to_string(setup.resolution) +
                            (rest == FROND_REST_WITHOUT_GRAVITY ? " droops" : " stands");
    ModelPtr& model = session.models[key];
    if (!model) {
        constexpr double HEIGHT = 2.1;  // approximate height of both plants [m]
        frond_model_def def = frond_default_model_def();
        def.rest = rest;
        def.allow_stiffening = INFINITY;  // coarse chains and cages are measured, too
        (chain ? def.capsule_height : def.cage_size) = HEIGHT / setup.resolution;
        model = load_plant(plant, def);
    }
    return model;
}

namespace {

const LoadFunction WEIGHT = [](Trial& trial, double share) { trial.set_gravity({0, -G * share, 0}); };

// Plants of linear tets, which grow as they rotate, may never come to rest.
int steps_to_rest(const Session& session) {
    return session.effort == Effort::FULL ? 300 : 40;
}

double height_of(const Model& model) {
    return model.info().upper.y - model.info().lower.y;
}

using Shape = std::vector<double>;  // vertices of the render mesh
Shape shape_of(Trial& trial) {
    frond_surface_view view;
    must(frond_plant_get_surface(trial.plant, &view));
    return Shape(view.positions, view.positions + 3 * view.vertex_count);
}

Shape drawn_shape(const ModelPtr& model, const Setup& setup) {
    Trial trial(model, setup);
    return shape_of(trial);
}

// Returns the RMS distance of all vertices [m].
double shape_distance(const Shape& a, const Shape& b) {
    double square = 0;
    for (size_t i = 0; i < a.size(); i++) square += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(square / (double(a.size()) / 3));
}
double farthest_vertex(const Shape& a, const Shape& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i += 3)
        most = std::max(most, std::hypot(std::hypot(a[i] - b[i], a[i + 1] - b[i + 1]), a[i + 2] - b[i + 2]));
    return most;
}

// Returns the shape in which a plant comes to rest, as numbers to compare.
using AtRest = std::function<std::vector<double>(const Setup& setup)>;

// Rods have no cage that could lock, so they are the reference if the library has them, else the default mechanics.
Setup finest_setup(const Setup& setup) {
    Setup fine = setup;
    fine.plant = elastic_plant_def();
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++)
        if (std::strcmp(frond_mechanics_name(frond_mechanics(m)), "rod") == 0)
            fine.plant.mechanics = frond_mechanics(m);
    return fine;
}

// Refines in space until all levels are used, and notes the differences between successive ones.
const std::vector<double>& converged_rest(
    const Setup& setup, const AtRest& at_rest,
    const std::function<double(const std::vector<double>&, const std::vector<double>&)>& distance, Session& session) {
    std::vector<double>& reference = session.references["rest"];
    if (!reference.empty()) return reference;
    std::vector<int> levels = {8, 16};
    if (session.effort == Effort::QUICK) levels = {8, 12, 18};
    if (session.effort == Effort::FULL) levels = {12, 18, 27, 40, 60};
    Setup fine = finest_setup(setup);
    std::string differences;
    double last = 0, before = 0;
    for (int level : levels) {
        fine.resolution = level;
        const std::vector<double> finer = at_rest(fine);
        if (!reference.empty()) {
            before = last;
            last = distance(reference, finer);
            char text[64];
            std::snprintf(text, sizeof text, "%s%.2g at %d", differences.empty() ? "" : ", ", last, level);
            differences += text;
        }
        reference = finer;
    }
    const bool converges = levels.size() < 3 || last < before;
    session.notes.push_back(std::string("Reference: ") + frond_mechanics_name(fine.plant.mechanics) + ", " +
                            resolution_text(fine) +
                            ". What each refinement by half changed, as the error is measured: " + differences +
                            (converges ? "."
                                       : ". These do not shrink: the reference has not converged, and errors below "
                                         "the last of them mean nothing."));
    return reference;
}

// ---- standing and drifting ---------------------------------------------------------------------------------------

Outcome stand(const PlantCase& plant, const Setup& setup, Session& session) {
    const auto settled = [&](const Setup& given) {
        return settle(plant_model(plant, given, FROND_REST_WITHOUT_GRAVITY, session), given, 16, WEIGHT,
                      steps_to_rest(session));
    };
    const double height = height_of(*plant_model(plant, setup, FROND_REST_WITHOUT_GRAVITY, session));
    const auto distance = [=](const Shape& a, const Shape& b) { return shape_distance(a, b) / height; };
    const Shape& reference = converged_rest(
        setup, [&](const Setup& fine) { return shape_of(*settled(fine)); }, distance, session);
    const Shape drawn = drawn_shape(plant_model(plant, setup, FROND_REST_WITHOUT_GRAVITY, session), setup);
    const std::unique_ptr<Trial> rests = settled(setup);
    const Shape shape = shape_of(*rests);
    return outcome_of(*rests, distance(shape, reference),
                      {{"rms droop/height", distance(shape, drawn), distance(reference, drawn)}},
                      time_from(*rests, setup, session.effort, WEIGHT));
}

Outcome drift(const PlantCase& plant, const Setup& setup, Session& session) {
    const ModelPtr model = plant_model(plant, setup, FROND_REST_STANDS_AS_MODELLED, session);
    Trial trial(model, setup);
    WEIGHT(trial, 1);
    const double duration = session.effort == Effort::FULL ? 10 : session.effort == Effort::QUICK ? 2 : 0.2;
    const Shape drawn = shape_of(trial);
    const int looks = 20, steps = int(std::lround(duration / setup.dt / looks));
    double most = 0;
    for (int i = 0; i < looks; i++) {
        for (int k = 0; k < std::max(steps, 1); k++) trial.step(setup.dt);
        most = std::max(most, farthest_vertex(shape_of(trial), drawn));
    }
    char name[64];
    std::snprintf(name, sizeof name, "farthest vertex/height in %g s", duration);
    const double error = most / height_of(*model);
    return outcome_of(trial, error, {{name, error, 0}}, time_steps(trial, session.effort, WEIGHT));
}

// ---- pulled ------------------------------------------------------------------------------------------------------

constexpr double PULL = 0.2, PULLED_AT = 0.75;  // displacement and height of the pull, over the plant's height [-]
constexpr double HAND = 500;                    // stiffness of the hand's spring [N/m]

// Applies weight, and a hand that pulls the axis aside.
class Pulled {
public:
    Pulled(frond_vec3 point, double way) : point(point), way(way) {}
    void operator()(Trial& trial, double share) {
        WEIGHT(trial, 1);
        if (!frond_grab_is_valid(grab)) {  // at first, or left from a failed attempt
            must(frond_grab_create(trial.plant, point, HAND, &grab));
            must(frond_grab_get(grab, nullptr, &from, nullptr));
        }
        must(frond_grab_move(grab, {from.x + way * share, from.y, from.z}));
    }
    double force() const {
        frond_vec3 at, target;
        must(frond_grab_get(grab, &at, &target, nullptr));
        return HAND * (target.x - at.x);
    }

private:
    frond_vec3 point, from = {0, 0, 0};
    double way;
    frond_grab grab = {};
};

// Returns a point that is the same for all setups.
frond_vec3 place_to_pull(const PlantCase& plant, Session& session) {
    return tools::point_on_axis(plant_model(plant, standing_baseline(), FROND_REST_STANDS_AS_MODELLED, session)->handle,
                                PULLED_AT);
}

Outcome drag(const PlantCase& plant, const Setup& setup, Session& session) {
    const frond_vec3 place = place_to_pull(plant, session);
    // `force` receives the last force of the hand while the plant settles.
    const auto settled = [&](const Setup& given, double& force) {
        const ModelPtr model = plant_model(plant, given, FROND_REST_STANDS_AS_MODELLED, session);
        Pulled pulled(place, PULL * height_of(*model));
        const LoadFunction pull = [&](Trial& trial, double share) {
            pulled(trial, share);
            force = pulled.force();
        };
        return settle(model, given, 16, pull, steps_to_rest(session));
    };
    const std::vector<double>& reference = converged_rest(
        setup,
        [&](const Setup& fine) {
            double force = 0;
            settled(fine, force);
            return std::vector<double>{force};
        },
        [](const std::vector<double>& a, const std::vector<double>& b) { return std::abs(a[0] / b[0] - 1); }, session);
    double force = 0;
    const std::unique_ptr<Trial> rests = settled(setup, force);
    Pulled pulled(place, PULL * height_of(*rests->model));
    const double cpu =
        time_from(*rests, setup, session.effort, [&](Trial& trial, double share) { pulled(trial, share); });
    return outcome_of(*rests, std::abs(force / reference[0] - 1), {{"force of the hand [N]", force, reference[0]}},
                      cpu);
}

Outcome release(const PlantCase& plant, const Setup& setup, Session& session) {
    const ModelPtr model = plant_model(plant, setup, FROND_REST_STANDS_AS_MODELLED, session);
    const frond_vec3 place = place_to_pull(plant, session);
    // All setups start from the same state.
    Setup exact = setup;
    exact.plant.tuning.linear_solver = FROND_LINEAR_SOLVER_BLOCK;
    exact.plant.tuning.linear_tolerance = frond_default_plant_def().tuning.linear_tolerance;
    std::vector<double>& start =
        session.references[std::string("start ") + frond_mechanics_name(setup.plant.mechanics)];
    if (start.empty()) {
        Pulled pulled(place, PULL * height_of(*model));
        const LoadFunction pull = [&](Trial& t, double share) { pulled(t, share); };
        start = settle(model, exact, 16, pull, steps_to_rest(session))->state().x;
    }
    const Start begin = [&](Trial& trial) {
        trial.set_state({start, std::vector<double>(start.size(), 0.0)});
        WEIGHT(trial, 1);
    };
    // Find the highest vertex of the drawn shape.
    const Shape drawn = drawn_shape(model, setup);
    size_t highest = 0;
    for (size_t i = 0; i < drawn.size(); i += 3)
        if (drawn[i + 1] > drawn[highest + 1]) highest = i;
    const Where tip = [=](Trial& trial) {
        const Shape shape = shape_of(trial);
        return frond_vec3{shape[highest], shape[highest + 1], shape[highest + 2]};
    };
    return compare_path(model, setup, begin, tip, session.effort == Effort::FULL ? 4 : 0.4, session);
}

}  // namespace

Setup standing_baseline() {
    Setup setup;
    setup.body = Body::PLANT;
    return setup;
}

Outcome run_corn_stand(const Setup& setup, Session& session) {
    return stand(CORN, setup, session);
}
Outcome run_cucumber_stand(const Setup& setup, Session& session) {
    return stand(CUCUMBER, setup, session);
}
Outcome run_corn_drift(const Setup& setup, Session& session) {
    return drift(CORN, setup, session);
}
Outcome run_cucumber_drift(const Setup& setup, Session& session) {
    return drift(CUCUMBER, setup, session);
}
Outcome run_corn_drag(const Setup& setup, Session& session) {
    return drag(CORN, setup, session);
}
Outcome run_cucumber_drag(const Setup& setup, Session& session) {
    return drag(CUCUMBER, setup, session);
}
Outcome run_corn_release(const Setup& setup, Session& session) {
    return release(CORN, setup, session);
}
Outcome run_cucumber_release(const Setup& setup, Session& session) {
    return release(CUCUMBER, setup, session);
}

}  // namespace frond::study
