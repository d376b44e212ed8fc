// Target: calls of the C API in any order with any arguments. Functions that read files, and robots, are in fuzz_urdf.
#include "fuzz/looks.hpp"

using namespace frond::fuzz;

namespace {

frond_model shared_model() {
    static const frond_model model = [] {
        frond_set_log(nullptr, nullptr);
        const frond_stem stems[] = {{-1, {0, 0, 0}, {0, 0.3, 0}, 0.02, 0.015},
                                    {0, {0, 0.3, 0}, {0.15, 0.5, 0}, 0.012, 0.006}};
        frond_model_def def = frond_default_model_def();
        def.cage_size = 0.1;
        frond_model made = {};
        require(frond_model_from_stems(stems, 2, &def, &made) == FROND_OK, "no model");
        return made;
    }();
    return model;
}

void create_plant(Stage& s) {
    frond_plant_def def = frond_default_plant_def();
    def.position = {0.1 * s.input.below(5), 0, 0.1 * s.input.below(3)};
    def.mechanics = frond_mechanics(s.input.below(FROND_MECHANICS_COUNT));
    def.integrator = frond_integrator(s.input.below(FROND_INTEGRATOR_COUNT));
    def.collision = frond_collision(s.input.below(FROND_COLLISION_COUNT));
    def.tuning.linear_solver = frond_linear_solver(s.input.below(FROND_LINEAR_SOLVER_COUNT));
    def.starts_asleep = s.input.below(4) == 0;
    if (s.input.below(4) == 0) def.root_height = -1;
    if (s.input.below(8) == 0) def.position = s.input.vec();
    if (s.input.below(8) == 0) def.tuning.max_substeps = s.input.integer();
    if (s.input.below(8) == 0) def.effects = s.input.raw<uint32_t>();
    if (s.input.below(8) == 0) def.mass_damping = s.input.number();
    if (s.input.below(16) == 0) {
        double any_def[64];
        static_assert(sizeof any_def > sizeof(frond_plant_def), "room for the largest def");
        frond_fill_def(any_def, s.input.raw<uint32_t>());
        std::memcpy(&def.cookie, any_def, sizeof def.cookie);
    }
    if (s.plants.size() >= 4) return;
    frond_plant plant = {};
    if (frond_plant_create(s.world, s.model, &def, &plant) == FROND_OK) s.plants.push_back(plant);
}

void create_rigid(Stage& s) {
    frond_rigid_def def = frond_default_rigid_def();
    def.shape = frond_shape(s.input.below(FROND_SHAPE_COUNT));
    def.mass = s.input.number();
    def.state.position = s.input.vec();
    def.state.velocity = s.input.vec();
    def.size = {std::fabs(s.input.number()), 0.1, 0.1};
    if (s.rigids.size() >= 6) return;
    frond_rigid rigid = {};
    if (frond_rigid_create(s.world, &def, &rigid) == FROND_OK) s.rigids.push_back(rigid);
}

void set_rigid(Stage& s) {
    frond_rigid_state state = {};
    const frond_rigid rigid = s.any(s.rigids);
    frond_rigid_get_state(rigid, &state);
    state.position = s.input.vec();
    state.velocity = s.input.vec();
    frond_rigid_set_state(rigid, &state);
}

void set_state(Stage& s) {
    const frond_plant plant = s.plant();
    const int count = frond_plant_get_node_count(plant);
    std::vector<double> x(3 * size_t(count) + 3), v(x.size());
    frond_plant_get_state(plant, x.data(), v.data(), count);
    for (double& value : s.input.below(2) ? x : v)
        if (s.input.below(3) == 0) value += s.input.number();
    frond_plant_set_state(plant, x.data(), v.data(), s.input.byte() < 250 ? count : s.input.integer());
}

// Writes values as a game might.
void blow(const frond_vec3* points, int count, double time, frond_vec3* velocities, void* user) {
    for (int i = 0; i < count; i++) velocities[i] = {*static_cast<double*>(user) * points[i].y, std::sin(time), 0};
}

void set_wind(Stage& s) {
    static double strength;
    if (s.input.below(4) == 0) {
        strength = s.input.number();
        frond_world_set_wind_field(s.world, s.input.below(4) ? blow : nullptr, &strength);
    }
    frond_wind_def wind = frond_default_wind_def();
    wind.velocity = s.input.vec();
    wind.turbulence = s.input.number();
    wind.profile = frond_wind_profile(s.input.below(FROND_WIND_PROFILE_COUNT));
    frond_world_set_wind(s.world, s.input.below(4) ? &wind : nullptr);
}

void set_detail(Stage& s) {
    frond_detail_def def = frond_default_detail_def();
    def.rod_from = s.input.number();
    def.by_size = s.input.below(2) != 0;
    if (s.input.below(4) == 0) def.modal_from = def.still_from = s.input.number();
    if (s.input.below(4) == 0) def.distance = [](frond_plant, double distance, void*) { return -distance; };
    if (s.input.below(2)) frond_world_set_detail(s.world, s.input.below(3) ? &def : nullptr);
    frond_world_set_viewer(s.world, s.input.vec());
}

void move_plants(Stage& s) {
    const frond_plant plant = s.plant();
    frond_plant_def def;
    switch (s.input.below(4)) {
        case 0:
            frond_plant_set_transform(plant, s.input.vec(), {s.input.number(), s.input.number(), 0, 1});
            break;
        case 1:
            frond_plant_reset(plant);
            break;
        case 2:
            frond_world_shift_origin(s.world, s.input.vec());
            break;
        default:
            if (frond_plant_get_def(plant, &def) != FROND_OK || s.plants.size() >= 4) return;
            s.plants.emplace_back();
            require(frond_plant_create(s.world, s.model, &def, &s.plants.back()) == FROND_OK,
                    "a def is not taken back");
    }
}

void save_or_restore(Stage& s) {
    if (s.snapshot.empty() || s.input.below(2)) {
        s.snapshot.resize(frond_world_get_snapshot_size(s.world));
        require(frond_world_save(s.world, s.snapshot.data(), s.snapshot.size()) == FROND_OK, "not saved");
        require(frond_world_restore(s.world, s.snapshot.data(), s.snapshot.size()) == FROND_OK, "not restored");
        return;
    }
    frond_world_restore(s.world, s.snapshot.data(), s.snapshot.size());
}

void set_plastic(Stage& s) {
    const frond_plant plant = s.plant();
    std::vector<double> values(size_t(frond_plant_get_plastic_count(plant)));
    frond_plant_get_plastic(plant, values.data(), int(values.size()));
    for (double& value : values)
        if (s.input.below(4) == 0) value = s.input.number();
    frond_plant_set_plastic(plant, values.data(), s.input.byte() < 200 ? int(values.size()) : 0);
}

void load_chain(Stage& s) {
    const frond_plant plant = s.plant();
    frond_plant_add_chain_load(plant, s.input.integer(), s.input.vec(), s.input.vec());
    frond_plant_add_distributed_load(plant, s.input.integer(), s.input.vec());
    const frond_support support = {s.input.integer() % 2 == 0, frond_held_turns(s.input.integer()), s.input.vec()};
    const int supported = s.input.integer();
    frond_vec3 held;
    frond_plant_set_support(plant, supported, &support);
    frond_plant_get_support_force(plant, supported, &held, nullptr);
    if (s.input.integer() % 2 == 0) frond_plant_set_support(plant, supported, nullptr);
    std::vector<frond_section_force> forces(size_t(frond_plant_get_capsule_count(plant)));
    frond_plant_get_section_forces(plant, forces.data(), int(forces.size()));
    std::vector<frond_chain_state> states(size_t(frond_plant_get_chain_node_count(plant)));
    if (frond_plant_get_chain_state(plant, states.data(), int(states.size())) != FROND_OK || states.empty()) return;
    states.front().position = s.input.vec();
    states.back().angular_velocity = s.input.vec();
    frond_plant_set_chain_state(plant, states.data(), int(states.size()));
}

using Call = void (*)(Stage&);

// What holds and pushes a plant.
constexpr Call HOLDS[] = {
    [](Stage& s) {
        frond_grab grab = {};
        if (frond_grab_create(s.plant(), s.input.vec(), s.input.number() * 100, &grab) == FROND_OK)
            s.grabs.push_back(grab);
    },
    [](Stage& s) { frond_grab_move(s.any(s.grabs), s.input.vec()); },
    [](Stage& s) { frond_grab_destroy(s.any(s.grabs)); },
    [](Stage& s) {
        frond_bond bond = {};
        if (frond_bond_create(s.plant(), s.input.vec(), s.any(s.rigids), &bond) == FROND_OK) s.bonds.push_back(bond);
    },
    [](Stage& s) { frond_bond_destroy(s.any(s.bonds)); },
    [](Stage& s) { frond_plant_pin(s.plant(), s.node()); },
    [](Stage& s) { frond_plant_unpin(s.plant(), s.node()); },
    [](Stage& s) {
        frond_plant_add_force(s.plant(), s.node(), s.input.vec());
        load_chain(s);
    },
    [](Stage& s) { frond_plant_move_pin(s.plant(), s.node(), s.input.vec()); }};

constexpr Call CHANGES[] = {
    [](Stage& s) { frond_plant_set_effects(s.plant(), s.input.raw<uint32_t>() & FROND_EFFECT_ALL); },
    [](Stage& s) { frond_plant_set_mechanics(s.plant(), frond_mechanics(s.input.below(FROND_MECHANICS_COUNT))); },
    [](Stage& s) { frond_plant_break(s.plant(), s.input.integer()); },
    [](Stage& s) { frond_plant_wake(s.plant()); },
    [](Stage& s) { frond_world_set_gravity(s.world, s.input.vec()); },
    [](Stage& s) { frond_world_set_effects(s.world, s.input.raw<uint32_t>()); },
    [](Stage& s) { frond_plant_destroy(s.plant()); },
    [](Stage& s) { frond_world_set_interpolation(s.world, s.input.number()); },
    [](Stage& s) { frond_plant_set_integrator(s.plant(), frond_integrator(s.input.below(FROND_INTEGRATOR_COUNT))); },
    [](Stage& s) { frond_rigid_destroy(s.any(s.rigids)); }};

template <size_t COUNT>
void one_of(const Call (&calls)[COUNT], Stage& s) {
    calls[size_t(s.input.below(int(COUNT)))](s);
}
void hold(Stage& s) {
    one_of(HOLDS, s);
}
void change(Stage& s) {
    one_of(CHANGES, s);
}

void step(Stage& s) {
    frond_world_step(s.world, s.input.byte() < 220 ? 1.0 / 60 : s.input.number());
    for (frond_plant plant : s.plants) require_finite(plant);
}

constexpr Call CALLS[] = {create_plant,
                          create_rigid,
                          set_rigid,
                          set_state,
                          set_wind,
                          set_detail,
                          save_or_restore,
                          set_plastic,
                          look_at_plant,
                          look_at_world,
                          look_at_model,
                          hold,
                          hold,
                          change,
                          change,
                          move_plants,
                          step,
                          step,
                          step,
                          list_what_there_is};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr int MOST = 60;  // largest number of calls
    Input input = {data, size};
    Stage stage = {input, shared_model(), {}, {}, {}, {}, {}, {}};
    frond_world_def def = frond_default_world_def();
    def.response = frond_response(input.below(FROND_RESPONSE_COUNT));
    def.tuning.hash_layout = frond_hash_layout(input.below(FROND_HASH_LAYOUT_COUNT));
    def.parallel_for = [](int count, frond_job_fn* job, void* job_data, void*) {
        for (int i = count - 1; i >= 0; i--) job(job_data, i);
    };
    require(frond_world_create(&def, &stage.world) == FROND_OK, "no world");
    create_plant(stage);
    for (int i = 0; i < MOST && !input.is_empty(); i++) one_of(CALLS, stage);
    frond_world_destroy(stage.world);
    return 0;
}
