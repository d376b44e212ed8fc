// Laws: what has to hold after every step of every program, whatever it does.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>

#include "frond/frond.h"
#include "programs/program.hpp"

namespace frond::programs {

enum class Law { CALL, FINITE, FAR, ENERGY, HANDOVER, STRETCH, WORK, BITS, REPLAY, HOME, CRASH, COUNT };
const char* name_of(Law law);
const char* text_of(Law law);             // the law in words
Law law_called(const std::string& name);  // throws a SceneError that names the laws
using LawSet = uint32_t;                  // a bit a law
constexpr LawSet bit_of(Law law) {
    return LawSet(1) << int(law);
}

// A law that does not hold.
struct Breach : std::runtime_error {
    Breach(Law law, const std::string& text) : std::runtime_error(text), law(law) {}
    Law law;
};

using Places = std::vector<frond_vec3>;
Places places_of(frond_plant plant);
Places velocities_of(frond_plant plant);

// A plant, and what the laws know of it.
struct Standing {
    frond_plant handle = {};
    frond_model model = {};
    frond_plant_def def = {};
    frond_model_info info = {};
    double size = 0;              // diagonal of the modelled surface's box [m]
    Places home;                  // its nodes as it was made [m]
    std::vector<double> lengths;  // of capsules as modelled [m]
    double strength = 0;          // least Young's modulus times area of an organ [N]
    bool stands = true;           // as modelled, under its weight
    // What operations did to it.
    double carried = 0;        // how far it was put elsewhere, in all [m]
    bool is_strained = false;  // it may be drawn out by what holds or pushes it
    bool is_changed = false;   // it need not come home
};

// The greatest speed that operations gave anything, and the sums of forces and of their impulses.
struct Loads {
    double speed = 0, force = 0, impulse = 0;  // [m/s], [N], [N s]
    bool has_bodies = false;                   // something may press plants
};

class Laws {
public:
    Laws(frond_world world, LawSet checked);
    void after_step(std::map<int, Standing>& plants, const Loads& loads, double dt);
    // Checks a change of mechanics, which must not add energy; `step` steps the world [s].
    void change_mechanics(Standing& plant, frond_mechanics to, const std::function<void(double)>& step);
    static bool may_come_home(const Standing& plant);
    // Checks that a plant came home after that many steps of `dt` [s] without loads: to where it was made, or, if it
    // leans, to where an untouched one sags.
    static void expect_home(const Standing& plant, int steps, double dt);

private:
    void check_finite(const Standing& plant);
    void check_places(const Standing& plant, const Loads& loads);
    void check_lengths(const Standing& plant, const Loads& loads, bool is_touched);
    void check_energy(const std::map<int, Standing>& plants, double dt);
    void check_handover(const Standing& plant, double gained, double allowed, const std::function<void(double)>& step);
    void check_work(const std::map<int, Standing>& plants);

    bool checks(Law law) const { return checked & bit_of(law); }

    frond_world world;
    LawSet checked;
    double time = 0;                     // [s]
    frond_energy_ledger last = {};       // after the last step
    double turnover = 0, most = -1e300;  // sum of all work's magnitude, and the most that was dissipated [J]
    double error_at_most = 0;            // the ledger's error then [J]
    double parted = 0;                   // what parting of plants may have added [J]
    double kinetic = 0;                  // largest kinetic energy so far [J]
    std::vector<int> work;               // solves a plant in each step
};

}  // namespace frond::programs
