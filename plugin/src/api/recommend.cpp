// frond_recommend: a model and a bound come in, the best settings within it go out. Errors are computed for the model
// at hand (calibration/tip_sway.hpp), in chains of several lengths of capsules and in steps of several integrators;
// only the time that a step takes is a measured one.
#include <algorithm>
#include <cmath>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "calibration/other_chain.hpp"
#include "calibration/tip_sway.hpp"

using namespace frond;

namespace {

// CPU time of a step of rods by the number of capsules, of the plant alone in its world: straight lines within a tenth
// of what stems of 5 to 160 capsules took on an AMD EPYC, GNU 12.2.0 Release; consistent masses take up to 7 % more.
struct Cost {
    frond_integrator integrator;
    double of_step, of_capsule;  // [s]
};
constexpr Cost COSTS[] = {{FROND_INTEGRATOR_IMPLICIT_EULER, 3.7e-6, 0.66e-6},
                          {FROND_INTEGRATOR_BDF2, 3.8e-6, 0.68e-6},
                          {FROND_INTEGRATOR_SDIRK2, 5.3e-6, 1.31e-6}};

// Capsules from root to tip of the chains that are tried; the finest, with each capsule cut in two, is the reference.
constexpr int PIECES[] = {5, 7, 10, 14, 20, 28, 40, 57, 80, 113, 160};
constexpr int PARTS = 2;                               // into which the reference cuts each capsule
constexpr double LEAST_STEPS = 12, MOST_STEPS = 4000;  // in a period of the main mode

// Returns the length along the chain from a root to the farthest node [m].
double reach_of(const Model& model) {
    return model.chain.nodes[size_t(find_tip(model))].distance;
}

// A chain with one kind of masses.
struct Choice {
    double height;    // length of a capsule [m]
    double capsules;  // number of them
    frond_mass mass;
    TipSway sway;
    double least;  // error in exact steps [-]
};

struct Search {
    TipSway exact;
    double frequency;  // of the main mode [Hz]
    std::vector<Choice> choices;

    // Returns CPU seconds per simulated second.
    double cpu(const Choice& choice, const Cost& cost, double steps) const {
        return steps * frequency * (cost.of_step + cost.of_capsule * choice.capsules);
    }
    // Returns how many steps in a period a budget pays for.
    double steps_for(const Choice& choice, const Cost& cost, double budget) const {
        constexpr double ROUNDED = 1 - 1e-12;  // [-]
        return std::min(MOST_STEPS, ROUNDED * budget / cpu(choice, cost, 1));
    }
    // Returns the error, no less than that of exact steps, so that shorter steps keep it too.
    double error(const Choice& choice, const Cost& cost, double steps) const {
        return std::max(choice.least, sway_error(choice.sway, exact, cost.integrator, 1 / (steps * frequency)));
    }
};

void add_choices(const std::shared_ptr<const Model>& model, Search& search) {
    for (const frond_mass mass : {FROND_MASS_LUMPED, FROND_MASS_CONSISTENT}) {
        Choice choice;
        choice.height = model->chain.height;
        choice.capsules = std::max(1.0, double(model->chain.nodes.size()) - model->chain.root_count());
        choice.mass = mass;
        choice.sway = find_tip_sway(model, mass, &search.exact.direction);
        choice.least = sway_error(choice.sway, search.exact);
        search.choices.push_back(std::move(choice));
    }
}

Search begin_search(const std::shared_ptr<const Model>& model) {
    std::vector<std::shared_ptr<const Model>> models;
    std::shared_ptr<const Model> finest = model;
    if (can_be_cut_anew(*model)) {
        for (const int pieces : PIECES) models.push_back(with_capsules(*model, reach_of(*model) / pieces));
        finest = with_cut_capsules(*models.back(), PARTS);
    } else {
        models.push_back(model);
    }
    Search search;
    search.exact = find_tip_sway(finest, FROND_MASS_CONSISTENT);
    search.frequency = main_frequency(search.exact);
    for (const std::shared_ptr<const Model>& one : models) add_choices(one, search);
    return search;
}

frond_advice advise(const Search& search, const Choice& choice, const Cost& cost, double steps, double error) {
    frond_advice advice = {};
    advice.plant = frond_default_plant_def();
    advice.plant.mechanics = FROND_MECHANICS_ROD;
    advice.plant.integrator = cost.integrator;
    advice.plant.tuning.mass = choice.mass;
    advice.capsule_height = choice.height;
    advice.time_step = 1 / (steps * search.frequency);
    advice.error = error;
    advice.cpu = search.cpu(choice, cost, steps);
    return advice;
}

// Settings of a chain and an integrator with an error within a bound, or the least error that was found instead.
struct Found {
    double steps = 0;  // in a period; 0: none
    double error = INFINITY;
};

// Finds the fewest steps in a period, within some per cent and up to `most`, with an error within the bound.
Found fewest_steps(const Search& search, const Choice& choice, const Cost& cost, double bound, double most) {
    constexpr double GROWTH = 1.4, NEAR = 1.02;  // of steps from try to try; error in steps that is left [-]
    Found found;
    double too_few = LEAST_STEPS;
    for (double steps = LEAST_STEPS; steps <= most && found.steps == 0; steps *= GROWTH) {
        const double error = search.error(choice, cost, steps);
        found.error = std::min(found.error, error);
        if (error <= bound)
            found.steps = steps;
        else
            too_few = steps;
    }
    while (found.steps > NEAR * too_few) {
        const double middle = std::sqrt(found.steps * too_few), error = search.error(choice, cost, middle);
        if (error <= bound)
            found = {middle, error};
        else
            too_few = middle;
    }
    return found;
}

// Returns the cheapest settings with an error within the bound.
frond_advice cheapest(const Search& search, double bound) {
    frond_advice best = {};
    best.cpu = INFINITY;
    double least = INFINITY;
    for (const Choice& choice : search.choices) {
        if (choice.least > bound) {
            least = std::min(least, choice.least);
            continue;
        }
        for (const Cost& cost : COSTS) {
            const double most = search.steps_for(choice, cost, best.cpu);
            const Found found = fewest_steps(search, choice, cost, bound, most);
            least = std::min(least, found.error);
            if (found.steps > 0 && search.cpu(choice, cost, found.steps) < best.cpu)
                best = advise(search, choice, cost, found.steps, found.error);
        }
    }
    if (best.time_step == 0)
        fail(FROND_RESULT_UNSUPPORTED, "no settings have an error of %g; the least is %g", bound, least);
    return best;
}

// Returns the most accurate settings that take no more than so much CPU time a second.
frond_advice most_accurate(const Search& search, double budget) {
    frond_advice best = {};
    best.error = INFINITY;
    double least = INFINITY;
    // The finest chains come first, beside whose errors those of most others need not be looked at.
    for (size_t i = search.choices.size(); i-- > 0;)
        for (const Cost& cost : COSTS) {
            const Choice& choice = search.choices[i];
            least = std::min(least, search.cpu(choice, cost, LEAST_STEPS));
            const double steps = search.steps_for(choice, cost, budget);
            if (steps < LEAST_STEPS || choice.least > best.error) continue;
            const double error = search.error(choice, cost, steps);
            if (error < best.error) best = advise(search, choice, cost, steps, error);
        }
    if (best.time_step == 0)
        fail(FROND_RESULT_UNSUPPORTED, "no settings take only %g s of CPU a second; the cheapest take %g", budget,
             least);
    return best;
}

}  // namespace

frond_result frond_recommend(frond_model model, double error, double cpu, frond_advice* out) {
    return give(out, [&] {
        check_range(error, 0, 1, "error");
        check_range(cpu, 0, 1e9, "cpu [s/s]");
        if ((error > 0) == (cpu > 0))
            fail(FROND_RESULT_BAD_ARGUMENT, "error is %g and cpu %g; one of them must be above 0, the other 0", error,
                 cpu);
        const Search search = begin_search(get(model));
        return error > 0 ? cheapest(search, error) : most_accurate(search, cpu);
    });
}
