// Plant: one instance of a model: everything that moves. It is simulated in the model's own frame, near the origin, so
// that a plant ten kilometres away is as exact as one at home; `position` and `rotation` place it in the world.
#pragma once

#include <list>
#include <mutex>

#include "plant/air.hpp"
#include "plant/fibres.hpp"
#include "plant/follow.hpp"
#include "plant/fragment.hpp"
#include "plant/load_work.hpp"
#include "plant/modal.hpp"
#include "plant/supports.hpp"
#include "solve/solve.hpp"

namespace frond {

// A user's spring between a surface vertex and a target.
struct Grab {
    int vertex;
    Vec3 target;       // world frame [m]
    double stiffness;  // [N/m]
    uint64_t handle;   // handle of the C API
};

// The nodes that the host sees: the cage's, with elements of order 2 also the middles of its edges.
struct CageNodes : TetNodes {
    VecX modelled;  // positions in the modelled shape [m]
};

// Change of velocities in the last substep, to predict the next one's end.
struct Trend {
    VecX v_end;  // [m/s]
    VecX rate;   // [m/s^2]
};

// Workspaces that the plants of one system take by turns: a plant has one only between the halves of a step.
struct Marks;
struct PlantBatch;
struct WorkspacePool {
    std::mutex mutex;
    std::vector<WorkspacePtr> free;
    std::vector<std::shared_ptr<PlantBatch>> batch;  // workspaces for batches
    size_t seats = 0;                                // number of plants that may need one: those that are awake
};
// A plant's claim to one. Free workspaces beyond the number of seats are deleted.
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

struct Pins {
    std::vector<uint8_t> pinned;  // one per cage node
    VecX pin_target;              // targets of pinned cage nodes, model frame [m]
    std::vector<int> anchor;      // chain node that holds each cage node if it is pinned
};

// How a plant is held when it is made; shared by all plants of a model that are held alike.
struct Foot : Pins {
    double root_height;  // as in the plant's def [m]
};

// The surface in the frame before the last one that was shown.
struct PreviousSurface {
    std::vector<float> positions;  // world frame [m]; empty: as now
    uint64_t substep;              // number of the world's substeps at the last frame
    float back;                    // time from the last frame to the end of that substep [s]
};

// Forces of the host until the end of its step, world frame.
struct HostForces {
    VecX on_nodes;  // on cage nodes [N]; empty: none yet
    VecX on_chain;  // forces and moments on chain nodes, six numbers each [N], [N m]; empty: none yet
};
// Returns them, made first if there are none yet.
HostForces& forces_of(Plant& plant);

// The inputs that a snapshot keeps as they are.
struct SavedInput : Pins {
    bool has_user_force = false;
    bool pins_changed = true;
    bool pins_are_own = false;  // changed by the host
};

// Inputs: what the host asked for. Only calls of the host change them.
struct PlantInput : SavedInput {
    bool stands_on_roots = false;  // held by the model's own root
    SolveSettings settings;
    double material_damping;   // share of the organs' damping ratios that is applied [-]
    double substep_tolerance;  // allowed local error of a position in a step, over the plant's size [-]
    int max_substeps;
    frond_mass mass;
    frond_effects effects;
    frond_collision collision = FROND_COLLISION_ORGANS;
    void* user = nullptr;

    std::vector<Spring> pin_springs;           // hold pinned cage nodes that are too few to hold a chain node
    std::unique_ptr<const Supports> supports;  // hold chain nodes in place of pins; null: there are none
    std::shared_ptr<const Foot> foot;          // initial pinned, pin_target and anchor

    std::list<Grab> grabs;
    std::unique_ptr<HostForces> forces;  // null: none yet
};

// The state that a snapshot keeps as it is.
struct SavedState {
    Motion motion;  // of the mechanics' nodes, model frame
    Trend trend;    // empty with one substep
    // Lengths at which fibres pull, over their own, after an entanglement; else empty [-].
    std::vector<double> fibre_give;
    float stretched = 0;        // energy in fibres after the last step; above zero the next one includes them [J]
    int substeps = 1;           // of the next step
    float recovers_for = 0;     // time left to recover from a state that no admissible load can reach [s]
    bool is_touched = false;    // in contact, which is resolved over whole steps
    bool is_entangled = false;  // deep in itself or another plant; crossed leaves come apart only by being stretched
};

// State: what a step continues from, and a snapshot keeps.
struct PlantState : SavedState {
    bool is_compressed = false;
    std::unique_ptr<ModalMotion> modal;      // of a chain in modal motion; else null
    std::unique_ptr<Blend> blend;            // of how it is seen, after a change of what is simulated; null: none
    std::unique_ptr<Elements> own_elements;  // elements of a plant that has yielded, with its plastic state; else null
    double stepped_by = 0;            // length of the last step, from x_good to here; 0: it was put here since [s]
    std::unique_ptr<AirState> air;    // null until the plant is in air
    Vec3 blown = Vec3::Zero();        // force of the last step's air, if there are no drags to compute it from [N]
    std::vector<Fragment> fragments;  // parts that came off
    std::shared_ptr<Parting> parting = no_parting();  // its own only if there are fragments
    // Compressed state, while all members above that a step changes are empty: displacements of the mechanics' nodes
    // from the modelled shape [m]; empty: none.
    std::vector<float> away;
};

// What contacts do to a plant in a step.
struct ContactPush {
    VecX impulse;           // on the nodes of the mechanics [N s]; empty: none
    double share = 1;       // of it that the plant takes, less where it has turned away from what pushes it [-]
    double gone = 1;        // share of the solved way that the plant goes [-]
    double asked_work = 0;  // of the impulse along the velocities at which it is to part from what stands [J]
    double most_work = 0;   // that all of it can have done [J]
    // Where the plant's elastic energy was last computed, and that [J].
    VecX x;
    double elastic = 0;
};

// Scratch of the running step: nothing of it outlives the step but memory.
struct PlantStep {
    // Kept to reuse their memory; null while the plant is compressed.
    std::unique_ptr<Loads> loads = std::make_unique<Loads>();
    WorkspacePtr workspace;             // from the pool; refers to system and own elements
    SolveSettings settings;             // the plant's without effects that are off
    VecX x_good, v_good;                // before the step; empty after a healthy batched one: in the history
    std::unique_ptr<ContactPush> push;  // null until contacts are known
    double takes = 1;                   // share of pushes that its responses in this step take at most [-]
    std::unique_ptr<LoadWork> work;     // of an accepted step; null: nobody keeps account
    std::vector<int> bonded;            // vertices on fibres that bonds hold
    bool is_watched = false;            // near something that it may go through
    bool is_among_bodies = false;       // something that it is not swept against may be in its way
    bool is_pressed = false;            // in contact with something that may move
    bool is_sound = true;               // the solution can be the next state
    bool is_off_course = false;         // something ended the step off course
    bool is_inexact = false;            // the most substeps did not keep its error as small as asked
    bool may_yield = true;              // it may cause yielding, as far as is known
    bool has_fibres = true;             // fibres may pull
    bool starts_anew = false;           // it has no past, since the host changed something
    bool looks_back = false;            // it continues from its history, if it can be batched
};

// View: what follows the state for those who look at the plant.
struct PlantView {
    std::vector<Vec3> chain_positions;                      // model frame [m]
    std::vector<float> surface_positions, surface_normals;  // world frame
    std::unique_ptr<PreviousSurface> previous;              // null: never requested
    mutable VecX cage_x;  // cage nodes if they are not the mechanics' own, model frame [m]
    mutable bool cage_stale = true;
    mutable std::shared_ptr<const Marks> marks;  // null: never asked for
    bool surface_stale = true;
    uint32_t surface_made = 0;  // number of substeps when it was made
    float surface_back = 0;     // time before the end of the last substep at which the surface is drawn [s]
    double lead = 0;            // time by which the drawn cage is extrapolated until the plant is stepped again [s]
};

// The host always sees the cage's nodes. If the mechanics move the chain, the cage follows it.
struct Plant {
    // What it is made of; changes with the mechanics alone.
    std::shared_ptr<const Model> model;
    std::shared_ptr<const CageNodes> nodes;
    std::shared_ptr<const System> system;
    std::shared_ptr<const Follow> follow;  // null if the mechanics move the cage itself
    std::shared_ptr<const Fibres> fibres;  // null if none can pull
    PoolSeat seat;                         // claim to a workspace of the system's pool
    frond_mechanics which;
    float size;   // diagonal of the modelled surface's box [m]
    double sway;  // frequency of the slowest mode; 0: none [Hz]

    Vec3 position;  // origin of the model's frame in the world [m]
    Quat rotation;

    PlantInput input;
    PlantState state;
    PlantStep step;
    PlantView view;

    // Results of the last step.
    SolveReport report;
    uint32_t trouble = 0;
    float ms_effects = 0, ms_surface = 0, ms_normals = 0;
    // Parts of ms_effects, and further times [ms].
    float ms_user_force = 0, ms_air = 0, ms_fibres = 0, ms_plasticity = 0;

    Vec3 to_world(const Vec3& p) const { return rotation * p + position; }
    Vec3 to_model(const Vec3& p) const { return rotation.conjugate() * (p - position); }
};

// Creates a plant; the caller has checked `def`.
std::unique_ptr<Plant> create_plant(std::shared_ptr<const Model> model, const frond_plant_def& def);
// Returns the def with which the plant would be made as it is set now, except for what belongs to the world.
frond_plant_def def_of(const Plant& plant);
// Returns whether a plant's step ends only when those of others are known.
inline bool waits(const Plant& plant) {
    return plant.state.is_touched || plant.step.is_watched;
}
// Returns the time of stillness after which the plant counts as at rest, half a period of its slowest mode [s].
double rest_time(const Plant& plant);
// Compress a plant at rest and restore it: to the same position within 1e-8 m, or to the modelled shape if no node is
// farther from there than `tolerance`. `keep_surface` keeps the surface.
void compress(Plant& plant, double tolerance, bool keep_surface);
void decompress(Plant& plant);
std::shared_ptr<const AirPieces> air_pieces_of(const Plant& plant);
std::shared_ptr<const ModalBasis> modal_basis_of(const Plant& plant);
const std::shared_ptr<const Marks>& marks_of(const Plant& plant);  // only if the mechanics move the cage
Vec3 air_force(const Plant& plant);                                // of the last step, world frame [N]
// Ends forces given by frond_plant_add_force.
void clear_user_force(Plant& plant);
// Writes surface_positions and surface_normals as far as the effects ask for them, as they were `back` before the end
// of the last substep [s], or extrapolated if it is negative.
void update_surface(Plant& plant, frond_effects effects, double back = 0);
frond_energy energy_of(const Plant& plant, const Vec3& gravity);
// Returns the elastic energy that the plant has with its nodes there, of the mechanics and of fibres [J].
double elastic_energy(const Plant& plant, const VecX& x);
// Returns the surface vertex nearest to a point of the world.
int nearest_vertex(const Plant& plant, const Vec3& point);
Vec3 vertex_position(const Plant& plant, int vertex);  // world frame [m]
std::vector<Vec3> vertex_positions(const Plant& plant);
// Returns the position of a point that follows the cage, with the cage's nodes at x.
Vec3 bound_point(const Plant& plant, const Embedding& embedding, size_t i, const VecX& x);
// Spring that pulls at a grabbed vertex, as it is solved; the vertex is not on a fragment.
Spring grab_spring(const Plant& plant, const Grab& grab);
// Where a grab or a bond holds the plant [m], and a grab's force on it [N]; world frame. That is the vertex in the
// mechanics, not as it is drawn while a change of mechanics is blended out.
Vec3 pulled_place(const Plant& plant, int vertex);
Vec3 grab_force(const Plant& plant, const Grab& grab);
// Moves all nodes [world frame]; pinned nodes stay where they are put. Null arrays leave positions or velocities
// unchanged.
void set_state(Plant& plant, const double* positions, const double* velocities);
// Ends a change of the motion of a chain from outside: what is pinned stays where it is now.
void go_on_from_state(Plant& plant);
// Get and set the plastic state in numbers; none if nothing has yielded. Setting none removes all plastic strain.
std::vector<double> plastic_of(const Plant& plant);
void set_plastic(Plant& plant, const std::vector<double>& values);
void update_chain(Plant& plant);
// Returns the strain in the outermost fibre of each capsule of Model::capsules [-].
std::vector<double> capsule_strains(const Plant& plant);
// Returns the ends of a capsule of Model::capsules, model frame [m].
std::array<Vec3, 2> capsule_ends(const Plant& plant, size_t capsule);
// Updates after a change of the motion: the chain now, cage and surface when they are next read.
void moved(Plant& plant);

int node_count_of(const Plant& plant);
// Returns the plant's own elements if it has yielded, else the system's.
const Elements& elements_of(const Plant& plant);
// Returns the position of a cage node, which may be in a fragment, world frame [m].
Vec3 node_place(const Plant& plant, int node);
// Returns its velocity; `v` are cage_velocities() [m/s].
Vec3 node_velocity(const Plant& plant, const VecX& v, int node);
// Returns the positions of the cage nodes, model frame [m]. The reference holds until the plant moves.
const VecX& cage_places(const Plant& plant);
VecX cage_velocities(const Plant& plant);  // [m/s]
// Returns the attachment of a vertex, for forces on it.
Attachment vertex_attachment(const Plant& plant, int vertex);
// Returns the attachment of a chain node, if the mechanics move tets.
Attachment chain_attachment(const Plant& plant, int node);

// Potential energy of tissue and weight, relative to the modelled shape's, and kinetic energy [J]. The weight's is by
// the gravity of the last step; none if there was none.
struct StoredEnergy {
    double potential, kinetic;
};
StoredEnergy stored_energy(const Plant& plant);
// Relaxes a plant until it stores no more than that. Pins that were moved since the last step are left to the next one.
void relax(Plant& plant, const StoredEnergy& most, bool pins_moved);
// Switches to other mechanics with the same shape and motion. `smoothly`: between cage and chain only the modal part of
// a plant that sways on its roots is handed over, which strains neither, and the rest of shape and motion blends out.
void set_mechanics(Plant& plant, frond_mechanics which, bool smoothly = false);
// Gives a plant mechanics as a new one has them: as modelled, at rest and whole.
void take_mechanics(Plant& plant, frond_mechanics which);

}  // namespace frond
