// Snapshot: all that steps change in a world, without the objects themselves. References are indices: of plants in the
// world, of bodies among Bullet's collision objects.
#pragma once

#include "core/archive.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

struct SavedContact {
    int plant, other;
    Contact contact;  // without its pointers, and what only a running step needs
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
    FragmentMotion motion;
};

struct SavedPlant {
    uint64_t kind;  // hash of model, place and settings, which must be the plant's
    frond_mechanics which;
    SavedInput input;
    SavedState state;
    double lead;
    std::vector<Blend> blend;       // none or one
    std::vector<ModalState> modal;  // likewise
    bool has_own_elements;
    std::vector<double> plastic;
    std::vector<Support> supports;
    HostForces forces;
    std::vector<Vec3> grab_targets;
    std::vector<SavedFragment> fragments;
    VecX parted_at;  // Parting::start of a plant with fragments
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
    btTransform frame, frame_before;
    btVector3 velocity, angular_velocity, velocity_before, angular_velocity_before, force, torque;
    int activation;
    btScalar still;
    bool has_left;
};
struct SavedAhead {
    int body;
    btVector3 force;
};
struct SavedBond {
    int vertex, body;  // -1: it holds nothing any more
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
