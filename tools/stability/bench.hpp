// Bench: the world of one cell, and the building blocks of criteria.
#pragma once

#include <random>
#include <stdexcept>

#include "scenes/lattice.hpp"
#include "scenes/scene.hpp"
#include "scenes/vector.hpp"
#include "stability/stability.hpp"

namespace frond::stability {

using tools::must;

struct Broken : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct DoesNotApply : std::runtime_error {
    using std::runtime_error::runtime_error;
};

using tools::length;
using tools::operator+;
using tools::operator-;
using tools::operator*;

using Places = std::vector<frond_vec3>;

class Bench {
public:
    explicit Bench(const Cell& cell);
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;
    ~Bench();

    const Cell cell;
    frond_world_def world_def;  // def of the world, which is made with the first plant or body
    frond_plant_def plant_def;  // def of later plants: the default one without plasticity
    double box = 20;            // largest distance of any part of a plant from its start [m]
    uint32_t trouble = 0;       // bits of all steps
    std::mt19937 random{1};
    double between(double low, double high);

    // Takes ownership of the model.
    frond_model keep(frond_model model);
    frond_plant add(frond_model model, const frond_vec3& position = {});
    frond_rigid add(const frond_rigid_def& def);
    void remove(frond_plant plant);
    frond_world world();

    // Take steps of the cell's length, or of a given one; after each, all that Frond reports must be finite and in the
    // box.
    void run(double seconds);
    void run(double seconds, const std::function<void(double time)>& before_each);
    void step(double dt);
    void check();

    Places places(frond_plant plant) const;
    Places velocities(frond_plant plant) const;
    void put(frond_plant plant, const Places& places);
    void push(frond_plant plant, const Places& velocities);
    double energy() const;          // energy of all plants [J]
    double kinetic_energy() const;  // [J]
    double fastest() const;         // speed of the fastest node of all plants [m/s]
    double time() const;

    // Pins the cage nodes below a height above the origin of the model at rest, for a plant made without pins.
    std::vector<int> hold(frond_plant plant, double height);
    void move(frond_plant plant, const std::vector<int>& nodes, const std::function<frond_vec3(const frond_vec3&)>& to);

    // Criteria.
    void expect(bool holds, const char* what, double measured, double bound) const;
    // Steps on; energy may exceed its initial value by a twentieth of the part above `rest`, plus the work of lifting
    // the plant by a hundredth of its size.
    void expect_no_energy_from_nothing(double seconds, double rest);
    // Checks that no tet is inverted, if tets are what moves, and that the mean distance of nodes from their expected
    // positions is within a share of the plant's size.
    void expect_shape(frond_plant plant, const Places& rest, double share) const;

private:
    struct Entry {
        frond_plant plant;
        frond_model model;
        Places start;
    };
    const Entry& entry_of(frond_plant plant) const;
    std::vector<Entry> entries;
    std::vector<frond_model> models;
    frond_world handle = {};
    Places held_from;
};

// Models of most cases, made once and shared by all processes.
frond_model beam();  // 200 tets, upright, 1 m x 0.1 m x 0.1 m, 10 MPa, 800 kg/m^3: clamped at its foot with FOOT
frond_model herb();  // made of stems: 0.6 m high, a branch and a leaf stalk, standing as modelled, in Frond's own cage
constexpr double FOOT = 0.01;  // [m]

using tools::even_heights;
using tools::Lattice;
using tools::make_lattice;
frond_material plain_material();  // 10 MPa, 800 kg/m^3, Poisson's ratio 0.3
frond_model model_of(const Lattice& lattice, const frond_material& material);

}  // namespace frond::stability
