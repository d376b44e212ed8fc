// Bench: the world of one cell, and what criteria are made of.
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
    frond_world_def world_def;  // of the world, which is made with the first plant or body
    frond_plant_def plant_def;  // of plants to come: the default one, but that nothing yields
    double box = 20;            // how far from where it began anything of a plant may be [m]
    uint32_t trouble = 0;       // of all steps
    std::mt19937 random{1};
    double between(double low, double high);

    // Takes the model over.
    frond_model keep(frond_model model);
    frond_plant add(frond_model model, const frond_vec3& position = {});
    frond_rigid add(const frond_rigid_def& def);
    void remove(frond_plant plant);
    frond_world world();

    // Steps of the cell's length, or of one's own; after each everything that Frond tells is finite and in the box.
    void run(double seconds);
    void run(double seconds, const std::function<void(double time)>& before_each);
    void step(double dt);
    void check();

    Places places(frond_plant plant) const;
    Places velocities(frond_plant plant) const;
    void put(frond_plant plant, const Places& places);
    void push(frond_plant plant, const Places& velocities);
    double energy() const;          // of all plants [J]
    double kinetic_energy() const;  // [J]
    double fastest() const;         // node of all plants [m/s]
    double time() const;

    // Pins the cage nodes that are lower than that above the origin of the model at rest; the plant is made without
    // pins.
    std::vector<int> hold(frond_plant plant, double height);
    void move(frond_plant plant, const std::vector<int>& nodes, const std::function<frond_vec3(const frond_vec3&)>& to);

    // Criteria.
    void expect(bool holds, const char* what, double measured, double bound) const;
    // Steps on, and energy never goes over what it began with, by a twentieth of what is above `rest`, or by what lifts
    // the plant by a hundredth of its size.
    void expect_no_energy_from_nothing(double seconds, double rest);
    // No tet is inside out, where the tets are what moves, and nodes are within a share of the plant's size of where
    // they should be, in the mean.
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

// Models that most cases use, made once and shared by all processes.
frond_model beam();  // of 200 tets, upright, 1 m x 0.1 m x 0.1 m, 10 MPa, 800 kg/m^3: clamped at its foot with FOOT
frond_model herb();  // of stems: 0.6 m high, a branch and a leaf stalk, standing as modelled, in Frond's own cage
constexpr double FOOT = 0.01;  // [m]

using tools::even_heights;
using tools::Lattice;
using tools::make_lattice;
frond_material plain_material();  // 10 MPa, 800 kg/m^3, Poisson's ratio 0.3
frond_model model_of(const Lattice& lattice, const frond_material& material);

}  // namespace frond::stability
