// Trial: a plant in a world of its own, for one run of a problem: loads at its end, long steps until rest, timed steps.
#pragma once

#include <functional>
#include <memory>

#include "study/study.hpp"

namespace frond::study {

constexpr double G = 9.81;  // [m/s^2]

// A beam of 1 m, upright from the origin, clamped at its foot.
struct Beam {
    double width;    // side of the square, or diameter of the circle [m]
    double young;    // Young's modulus [Pa]
    double density;  // [kg/m^3]
    double poisson = 0.3;
    // Cells across and along of structured tets; cubes unless specified.
    struct Cells {
        int across, along;
    } cells[2] = {};
    static constexpr double LENGTH = 1;  // [m]
    static constexpr double DRAG = 1.2;  // coefficient in air [-]
};
// Returns the beam that other programs were tested with: 0.1 m wide, 10 MPa, 800 kg/m^3, in 1170 or 20090 tets.
Beam peers_beam();
// Properties of the section of a body.
double area_of(const Beam& beam, Body body);
double inertia_of(const Beam& beam, Body body);           // second moment of area [m^4]
double torsion_constant_of(const Beam& beam, Body body);  // [m^4]

class Model {
public:
    explicit Model(frond_model handle) : handle(handle) {}
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
    ~Model() { frond_model_destroy(handle); }
    const frond_model handle;
    frond_model_info info() const;
};
using ModelPtr = std::shared_ptr<const Model>;
ModelPtr make_beam(const Beam& beam, const Setup& setup);
// Returns the mass of each rounded end of a stem, which is not in the formula, over the beam's own [-].
double cap_mass(const Beam& beam, Body body, const Model& model);

class Trial {
public:
    Trial(ModelPtr model, const Setup& setup);
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    ~Trial();

    // Return the surface vertices of a section across the model at rest, at a height [m], and their current middle.
    const std::vector<int>& section(double height);
    frond_vec3 middle(double height);
    // Returns the angle by which the section has turned about the axis of the beam at rest [rad].
    double twist(double height);
    // Returns the heights at which the surface has a section, from 0 to the beam's length [m].
    std::vector<double> section_heights(double length) const;

    void set_gravity(frond_vec3 gravity);
    // Applies a force [N] and a moment [N m] at the middle of the end section, by the nodes around it, in the next
    // step.
    void push_end(frond_vec3 force, frond_vec3 moment);
    // Applies forces of a given density along the beam [N/m], in x, in the next step.
    void push_along(double length, const std::function<double(double)>& density);
    void step(double dt);

    struct State {
        std::vector<double> x, v;
    };
    State state() const;
    void set_state(const State& state);
    // Starts from the shape of a plant of the same model, without motion.
    void start_from(const Trial& rests);

    ModelPtr model;
    Setup setup;
    frond_world world = {};
    frond_plant plant = {};
    double cpu = 0;  // CPU time of all steps so far [s]
    uint32_t trouble = 0;

private:
    const std::vector<int>& end_nodes();
    std::vector<float> rest_surface;
    std::vector<double> rest_nodes;
    std::map<long, std::vector<int>> sections;
    std::vector<int> ends;
};

// Applies loads for the next step, as a share of the full ones.
using LoadFunction = std::function<void(Trial& trial, double share)>;

// Returns a plant that rests under the loads, which are raised in `ramp` long steps of an integrator that damps all
// motion. After `most_steps` it is returned as it is.
std::unique_ptr<Trial> settle(const ModelPtr& model, const Setup& setup, int ramp, const LoadFunction& load,
                              int most_steps = 300);

// Returns CPU seconds per simulated second: steps repeatedly from the same state; the least of the repeats counts.
double time_steps(Trial& trial, Effort effort, const LoadFunction& load);
// Does the same for a plant with this setup in the state of one that rests.
double time_from(const Trial& rests, const Setup& setup, Effort effort, const LoadFunction& load);
// Fills in what every outcome reports.
Outcome outcome_of(Trial& trial, double error, std::vector<Value> values, double cpu_per_second);

}  // namespace frond::study
