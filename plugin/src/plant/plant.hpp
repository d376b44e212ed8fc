// Plant: one instance of a model, everything that moves. It is simulated in the model's own frame, near the origin, so
// that a plant ten kilometres away is as exact as one at home; `position` and `rotation` place it in the world.
#pragma once

#include <list>
#include <mutex>

#include "plant/air.hpp"
#include "plant/fibres.hpp"
#include "plant/follow.hpp"
#include "plant/fragment.hpp"
#include "plant/modal.hpp"
#include "solve/solve.hpp"

namespace frond {

// A user's hold on a surface vertex.
struct Grab {
    int vertex;
    Vec3 target;       // world frame [m]
    double stiffness;  // [N/m]
    uint64_t handle;   // of the C API
};

// The nodes that the host sees, the cage's; with elements of order 2 the middles of its edges are among them.
struct CageNodes : TetNodes {
    VecX modelled;  // where they are in the modelled shape [m]
};

// How velocities changed in the last substep, for a guess of the next one's end.
struct Trend {
    VecX v_end;  // [m/s]
    VecX rate;   // [m/s^2]
};

// Workspaces that the plants of one system lend from each other: one has its own only between the halves of a step.
struct PlantBatch;
struct WorkspacePool {
    std::mutex mutex;
    std::vector<WorkspacePtr> free;
    std::vector<std::shared_ptr<PlantBatch>> batch;  // likewise, of several plants at once
    size_t seats = 0;                                // plants that may ask for one: those that are awake
};
// A plant's right to one. Without as many seats, free workspaces go.
struct PoolSeat {
    std::shared_ptr<WorkspacePool> pool;
    bool is_taken = false;
    PoolSeat() = default;
    PoolSeat(const PoolSeat&) = delete;
    PoolSeat& operator=(const PoolSeat&) = delete;
    ~PoolSeat() { leave(); }
    void take();
    void leave();
};

// How a plant is held when it is made; shared by all plants of a model that are held alike.
struct Foot {
    double root_height;  // as in the plant's def [m]
    std::vector<uint8_t> pinned;
    VecX pin_target;
    std::vector<int> anchor;
};

// Where the surface was in the frame before the last one that was shown.
struct PreviousSurface {
    std::vector<float> positions;  // world frame [m]; empty: where it is
    uint64_t substep;  // the last frame: the world's substeps until then, and how long before the end of the
    float back;        // last one it was [s]
};

// Nodes that the host sees are the cage's, whatever moves. Where the mechanics move the chain, the cage follows it.
struct Plant {
    std::shared_ptr<const Model> model;
    std::shared_ptr<const CageNodes> nodes;
    frond_mechanics which;
    frond_mass mass;
    std::shared_ptr<const System> system;
    std::unique_ptr<Elements>
        own_elements;                       // of a plant that has yielded, with what of its shape is lasting; else null
    PoolSeat seat;                          // among the plants of the system
    WorkspacePtr workspace;                 // lent for a step; refers to system and own elements
    SolveSettings settings, step_settings;  // the latter without what the running step's effects leave out
    double material_damping;                // share of the organs' damping ratios that counts [-]
    double substep_tolerance;               // local error of a place in a step, over the plant's size [-]
    Trend trend;                            // empty with one substep
    double rest_time;                       // for which a plant that rests has been still [s]
    Vec3 position;                          // of the model's frame in the world [m]
    Quat rotation;
    void* user = nullptr;

    Motion motion;                         // of what the mechanics move, model frame
    std::shared_ptr<const Follow> follow;  // null where the cage itself moves
    std::unique_ptr<ModalMotion> modal;    // of a chain that only sways; else null
    BlendOut blend_out;                    // of the cage, beside where the mechanics have it
    double lead = 0;                       // for which the cage is drawn to go on, until the plant is stepped again [s]
    double stepped_by = 0;                 // the last step, from x_good to here; 0: it was put here since [s]
    std::shared_ptr<const Fibres> fibres;  // null where none pulls
    std::vector<double>
        fibre_give;               // lengths at which they pull, over their own, after an entanglement; else empty [-]
    std::vector<uint8_t> pinned;  // one a cage node
    VecX pin_target;              // where pinned cage nodes shall be, model frame [m]
    std::vector<int> anchor;      // the chain node that holds each cage node where it is pinned
    std::vector<Spring> pin_springs;   // hold pinned cage nodes that are too few to hold a chain node
    std::shared_ptr<const Foot> foot;  // the three above at first
    VecX x_good, v_good;   // before the running step, of the motion; empty after a healthy one abreast: in the history
    VecX contact_impulse;  // of the running step's contacts on the nodes of the mechanics [N s]; empty: none
    VecX contact_correction;        // likewise, of those that move the plant and give it no velocity
    Loads loads;                    // of the running step, kept to reuse its memory
    std::unique_ptr<AirState> air;  // null until the plant is in air
    Vec3 blown = Vec3::Zero();      // force of the last step's air, where no drags tell of it [N]
    VecX user_force;                // on cage nodes, until the end of the host's step, world frame [N]; empty: none yet
    std::list<Grab> grabs;

    std::vector<Fragment> fragments;                  // that came off
    std::shared_ptr<Parting> parting = no_parting();  // of its own only where there are fragments

    // What follows the cage.
    std::vector<Vec3> chain_positions;                      // model frame [m]
    std::vector<float> surface_positions, surface_normals;  // world frame
    std::unique_ptr<PreviousSurface> previous;              // null: nobody has asked
    mutable VecX cage_x;                                    // model frame [m]; where it is not what the mechanics have

    // Folded: put away as what it takes to unfold it. Then all above that a step changes is empty.
    std::vector<float> away;  // from the modelled shape, of what the mechanics move [m]; empty: it is at rest there

    // Small ones side by side: fields have thousands of plants.
    frond_effects effects;
    uint32_t trouble = 0;  // of the last step
    int max_substeps;
    int substeps = 1;           // of the next step
    bool is_touched = false;    // by bodies, which answer to whole steps
    bool is_pressed = false;    // and some of them may move
    bool is_entangled = false;  // deep in itself or another plant: leaves that cross come apart only by being drawn out
    bool has_user_force = false;
    bool pins_changed = true;
    bool pins_are_own = false;     // the host has changed them
    bool stands_on_roots = false;  // the model's own root holds it
    bool surface_stale = true;
    float surface_back = 0;  // for which the surface is drawn before the end of the last substep [s]
    mutable bool cage_stale = true;
    bool is_compressed = false;
    bool is_sound = true;        // what was found can be the next state
    bool is_off_course = false;  // in the running step something went elsewhere than it was heading
    float patience = 1;          // share of the work that searches are given [-]
    bool may_yield = true;       // in the running step, for all that is known
    bool looks_back = false;     // the running step does, as far as it may be taken abreast
    // From a shape to which nothing can have bent it; below zero: was so long caught where searches find no way [s].
    float recovers_for = 0;
    float size;  // of the modelled surface, from corner to corner [m]

    // Of the last step.
    SolveReport report;
    float ms_effects = 0, ms_surface = 0, ms_normals = 0;
    // Of ms_effects and of what is beside it [ms].
    float ms_user_force = 0, ms_air = 0, ms_fibres = 0, ms_plasticity = 0;

    Vec3 to_world(const Vec3& p) const { return rotation * p + position; }
    Vec3 to_model(const Vec3& p) const { return rotation.conjugate() * (p - position); }
};

// What the world gives to every plant of a step.
struct Surroundings {
    Vec3 gravity = Vec3::Zero();               // world frame [m/s^2]
    frond_effects effects = FROND_EFFECT_ALL;  // mask
    const Wind* wind = nullptr;                // null: there is no air
    double time = 0;                           // at the end of the step [s]
};

// `def` has been checked by the caller.
std::unique_ptr<Plant> create_plant(std::shared_ptr<const Model> model, const frond_plant_def& def);
// With which it would be made as it is set now, but for what is the world's.
frond_plant_def def_of(const Plant& plant);
// A step in two halves, between which contacts may change what the first one found: effects and solve; then accept,
// with what becomes lasting, or rewind, and the chain.
void solve_plant(Plant& plant, const Surroundings& surroundings, double h);
// The end of the first half: what is drawn out is held, and whether what was found can be the next state is told.
void finish_solving(Plant& plant, frond_effects effects, double h);
// The middle of the first half: plant.motion goes on by h under plant.loads.
SolveReport solve_in_substeps(Plant& plant, double h);
// Of the running step; gravity in the model's frame [m/s^2].
Vec3 gravity_in(const Plant& plant, const Surroundings& surroundings, frond_effects effects);
SolveSettings settings_for(const Plant& plant, frond_effects effects);
// Takes contact_impulse and contact_correction, if there are any, into the step that was solved, of a plant in touch:
// only now its energy tells whether the step went wrong. `lost`: by bodies that push it [J].
void add_contacts(Plant& plant, double h, double lost);
void accept_step(Plant& plant, const Surroundings& surroundings, double h);
// Instead of the second half, if the step was broken off: the plant stands where it stood before the first one.
void drop_step(Plant& plant);
// Both.
void step_plant(Plant& plant, const Surroundings& surroundings, double h);
// Before and after a step.
void take_workspace(Plant& plant);
void return_workspace(Plant& plant);
// Puts a plant that stands still away, and takes it out again: in the same place to 1e-8 m, or in the modelled shape if
// nothing of it is farther than that from there. The surface stays if it is asked to.
void compress(Plant& plant, double tolerance, bool keep_surface);
void decompress(Plant& plant);
// Sets the drags of the running step's loads.
void gather_air(Plant& plant, const Surroundings& surroundings, frond_effects effects, double h);
std::shared_ptr<const AirPieces> air_pieces_of(const Plant& plant);
std::shared_ptr<const ModalBasis> modal_basis_of(const Plant& plant);
Vec3 air_force(const Plant& plant);  // of the last step, world frame [N]
// Forces given by frond_plant_add_force end.
void clear_user_force(Plant& plant);
// Writes surface_positions and surface_normals as far as the effects ask for them, as they were `back` before the end
// of the last substep; below zero: as they will be if all goes on so [s].
void update_surface(Plant& plant, frond_effects effects, double back = 0);
frond_energy energy_of(const Plant& plant, const Vec3& gravity);
// The surface vertex nearest to a point of the world.
int nearest_vertex(const Plant& plant, const Vec3& point);
Vec3 vertex_position(const Plant& plant, int vertex);   // world frame [m]
Vec3 grab_force(const Plant& plant, const Grab& grab);  // on the plant, world frame [N]
// Moves all nodes [world frame]; pinned nodes stay where they are put. Null arrays leave that part as it is.
void set_state(Plant& plant, const double* positions, const double* velocities);
// All that is lasting in its shape, in numbers; none if nothing has yielded. Setting none makes it straight again.
std::vector<double> plastic_of(const Plant& plant);
void set_plastic(Plant& plant, const std::vector<double>& values);
void update_chain(Plant& plant);
// Of the outermost fibre of each capsule of Model::capsules [-].
std::vector<double> capsule_strains(const Plant& plant);
// Of a capsule of Model::capsules, model frame [m].
std::array<Vec3, 2> capsule_ends(const Plant& plant, size_t capsule);
// After the motion was changed: the chain now, cage and surface when somebody looks.
void moved(Plant& plant);

int node_count_of(const Plant& plant);
// Its own, if it has yielded.
const Elements& elements_of(const Plant& plant);
// Of cage nodes, world frame [m], wherever their fragments are.
Vec3 node_place(const Plant& plant, int node);
// `v` being cage_velocities() [m/s].
Vec3 node_velocity(const Plant& plant, const VecX& v, int node);
// Of the cage nodes, model frame [m]. Borrowed until the plant moves.
const VecX& cage_places(const Plant& plant);
VecX cage_velocities(const Plant& plant);  // [m/s]
// A point of the plant for forces on it.
Attachment vertex_attachment(const Plant& plant, int vertex);
// A node of the chain, where tets move.
Attachment chain_attachment(const Plant& plant, int node);

// Holds a cage node where it is, lets it go, or moves where it is held to (model frame).
bool is_pinned(const Plant& plant, int node);
void pin_node(Plant& plant, int node);
void unpin_node(Plant& plant, int node);
void move_pin(Plant& plant, int node, const Vec3& target);
// What the pins are for the nodes of the mechanics.
void apply_pins(Plant& plant);
// Tells whether the nodes of a chain that are held are where they shall be.
bool is_where_held(const Motion& motion);

// Lets go of what would snap back at once.
void relax(Plant& plant);
// Goes on with other mechanics from the same shape and motion. `smoothly`: between cage and chain only the swing is
// handed over, which strains neither, and the rest of shape and motion fades.
void set_mechanics(Plant& plant, frond_mechanics which, bool smoothly = false);

}  // namespace frond
