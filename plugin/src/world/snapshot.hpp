// Snapshot: all that steps change in a world, without the objects themselves. References are indices: of plants in the
// world, of bodies among Bullet's collision objects.
#pragma once

#include "core/archive.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct SavedContact {
    int plant, capsule, other;
    double along, across, gap, friction;
    Vec3 on_plant, on_other, normal, impulse;
    Foreseen foreseen;
};
struct SavedPlantContact {
    std::array<int, 2> plants;
    PlantContact contact;  // without its pointers to plants
};
struct SavedTouches {
    std::vector<SavedContact> with_bodies;
    std::vector<SavedPlantContact> with_plants;
};

struct SavedGrownIn {
    int capsule, other;
    double depth;
};
struct SavedFragment {
    int node;
    Mat3 turn;
    Vec3 shift, centre, velocity, angular_velocity;
};
struct SavedModal {
    std::array<double, 2> place, speed, rest, damping;
    double since;
    bool comes_to_rest, fresh;
    BlendOut blend_out;
};

struct SavedPlant {
    uint64_t kind;  // hash of model, place and settings, which must be the plant's
    frond_mechanics which;
    Motion motion;
    Trend trend;
    BlendOut blend_out;
    double lead;
    std::vector<SavedModal> modal;  // none or one
    bool has_own_elements;
    std::vector<double> plastic, fibre_give;
    std::vector<uint8_t> pinned;
    VecX pin_target;
    std::vector<int> anchor;
    std::vector<Support> supports;
    bool pins_changed, pins_are_own, has_user_force, is_touched, is_entangled;
    VecX user_force, chain_load, fibre_force;
    int substeps;
    float recovers_for;
    std::vector<Vec3> grab_targets;
    std::vector<SavedFragment> fragments;
    // State of its PlantBody.
    int16_t new_for;
    bool asleep;
    double still;
    VecX places;
    Vec3 air;
    Level level;
    std::vector<SavedGrownIn> grown_in;
    SavedTouches asleep_with;
};

struct SavedRigid {
    bool is_plane, is_fragment;
    std::array<btScalar, 12> frame, frame_before;  // basis by rows, origin
    std::array<btScalar, 3> velocity, angular_velocity, velocity_before, angular_velocity_before, force, torque;
    int activation;
    btScalar still;
    bool has_left;
};
struct SavedAhead {
    int body;
    std::array<btScalar, 3> force;
};
struct SavedBond {
    int vertex;
    Vec3 impulse;
    double length;
    Foreseen foreseen;
};

struct Snapshot {
    double time, travelled;
    uint64_t turn, substep;
    Vec3 gravity_before;
    frond_effects effects_before;
    bool is_held;
    std::vector<SavedPlant> plants;
    std::vector<SavedRigid> rigids;
    std::vector<SavedBond> bonds;
    std::vector<SavedAhead> ahead;
    std::vector<int> others_before;  // objects that the last substep knew, none of them a plant
    SavedTouches touches;
};

// Returns whether a body is a fragment of a plant that was whole in the snapshot, so that it goes when that is
// restored.
inline bool is_to_go(const Snapshot& snapshot, const Rigid& rigid) {
    return rigid.grown_on && snapshot.plants[size_t(rigid.grown_on->index)].fragments.empty();
}

// Describes the world as it is now. Sleeping plants are decompressed meanwhile.
Snapshot take_snapshot(World& world);
// Throws BAD_ARGUMENT or FILE_FORMAT, with nothing changed, if the snapshot does not fit the world.
void check_snapshot(World& world, const Snapshot& snapshot);
void put_snapshot(World& world, Snapshot snapshot);
// Returns a hash of a plant's model, place and settings.
uint64_t kind_of(const Plant& plant);

// Convert a snapshot to bytes and back, with a header of version, precision and checksum.
std::vector<uint8_t> bytes_of(Snapshot& snapshot);
Snapshot snapshot_from(const uint8_t* bytes, size_t count);

// Makes Bullet forget its pairs and contact points, so that steps depend on the present state and on nothing else. Does
// nothing unless Bullet's world is Frond's own.
void find_contacts_anew(World& world);

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
