// Run: a program as it runs, its things by their ids, and the laws that it has to keep.
#pragma once

#include <map>
#include <memory>
#include <set>

#include "frond/frond_robot.h"
#include "programs/host.hpp"
#include "programs/laws.hpp"
#include "scenes/scene.hpp"

namespace frond::programs {

struct Conditions {
    int threads = 1;
    LawSet laws = bit_of(Law::COUNT) - 1;  // those that are checked; with none there is no ledger
};

class Run {
public:
    Run(const Program& program, const Conditions& conditions);
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run();
    void go();         // throws a Breach
    void come_home();  // takes all loads away; throws a Breach if a plant does not come home

    // For operations.
    void make_world(const Operation& operation);
    // Takes ownership; `stands`: plants of it stand as modelled.
    void add_model(int id, frond_model model, bool stands);
    void add_shared_model(int id, frond_model model);
    void add_plant(int id, int model, const frond_plant_def& def);
    void remove_plant(int id);
    void step(double dt);
    // Tolerates refusals of arguments, but no bugs; returns whether the call was successful.
    bool check(frond_result result);
    void change_mechanics(int plant, frond_mechanics to);
    uint64_t hash() const;
    bool checks(Law law) const { return conditions.laws & bit_of(law); }
    bool is_own() const { return !host; }  // the world is Frond's own

    frond_world world = {};
    std::map<int, frond_model> models;
    std::map<int, Standing> plants;
    std::map<int, frond_rigid> bodies;
    std::map<int, frond_grab> grabs;
    std::map<int, frond_bond> bonds;
    std::map<int, frond_robot> robots;
    std::map<int, std::vector<uint8_t>> snapshots;
    Loads loads;
    double air_field = 0;          // strength of the program's own wind
    std::vector<uint64_t> hashes;  // after each step
    size_t at = 0;                 // the running operation
    int steps = 0;                 // taken by it so far

private:
    bool has_all(const Operation& operation) const;
    void end();

    const Program& program;
    const Conditions conditions;
    std::unique_ptr<tools::Team> team;
    std::unique_ptr<Host> host;
    std::unique_ptr<Laws> laws;
    std::vector<frond_model> own_models;
    std::set<int> drooping;  // models of which plants do not stand as modelled
};

// Return the first thing that an operation acts on, a plant, and its numbers x, y and z.
Standing& plant_of(Run& run, const Operation& operation);
frond_vec3 xyz(const Operation& operation);

// Helpers of operations, the same as in the C that source.cpp writes.
frond_vec3 vertex(frond_plant plant, int number);
int node(frond_plant plant, int number);
void kick(frond_plant plant, const frond_vec3& speed);
void bend(frond_plant plant, const frond_vec3& way);

}  // namespace frond::programs
