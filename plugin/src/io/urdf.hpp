// URDF: links and joints as a URDF file describes them, read and checked by the import program. Plants and robots are
// both made of it.
#pragma once

#include <string>
#include <vector>

#include "core/types.hpp"

namespace frond {

// Files with more are rejected.
constexpr uint32_t MOST_LINKS = 20000, MOST_SHAPES = 100000;

// A frame in another one: maps positions to turn * place + origin.
struct UrdfFrame {
    Vec3 origin = Vec3::Zero();  // [m]
    Quat turn = Quat::Identity();
    Vec3 operator*(const Vec3& place) const { return turn * place + origin; }
    UrdfFrame operator*(const UrdfFrame& inner) const { return {turn * inner.origin + origin, turn * inner.turn}; }
};

enum class UrdfKind { SPHERE, BOX, CYLINDER, CAPSULE, MESH };

struct UrdfShape {
    UrdfKind kind = UrdfKind::SPHERE;
    UrdfFrame frame;           // in the link
    Vec3 size = Vec3::Zero();  // radius; sides; radius and length along z, a capsule's without its ends; scale [m], [-]
    int mesh = -1;             // index into UrdfTree::meshes
    std::string material;      // name; "" if there is none
    bool has_color = false;
    std::array<float, 4> color = {1, 1, 1, 1};  // linear RGBA
};

enum class UrdfJoint { FIXED, REVOLUTE, CONTINUOUS, PRISMATIC, FLOATING };

struct UrdfLink {
    std::string name;
    int parent = -1;  // smaller than its own index; -1: the root, which comes first
    // The joint to the parent; the root has none.
    std::string joint_name;
    UrdfJoint joint = UrdfJoint::FIXED;
    UrdfFrame frame;              // in the parent, with the joint at zero
    Vec3 axis = Vec3::UnitX();    // in the link, unit length
    double lower = 0, upper = 0;  // limits of revolute and prismatic joints [rad], [m]
    double effort = 0;            // largest force or torque, 0: not given [N], [N m]
    double speed = 0;             // largest speed, 0: not given [m/s], [rad/s]
    // Inertia about the centre of mass, in a frame there.
    bool has_inertia = false;
    double mass = 0;  // [kg]
    UrdfFrame centre;
    Mat3 inertia = Mat3::Zero();  // [kg m^2]
    std::vector<UrdfShape> visuals, collisions;
    // Values of <frond organ="" name="" material="" mass="" stretching="" bending="" twisting="" taper=""/>; the
    // numbers describe a section in the middle of the link, all zero if there are none.
    std::string organ, organ_name, organ_material;
    double section_mass = 0;              // [kg/m]
    double stretching = 0, twisting = 0;  // EA [N], GJ [N m^2]
    double bending_x = 0, bending_y = 0;  // EI against bending towards the link's x and y axis [N m^2]
    double taper = 0;                     // see Section
};

// Triangles of a mesh file, as they are.
struct UrdfMesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

struct UrdfTree {
    std::string name;
    std::vector<UrdfLink> links;  // parents first; at least one
    std::vector<UrdfMesh> meshes;
};

// Which meshes are read: visual ones (of links without any, collision ones), or only collision ones.
enum class UrdfUse { SEEN, COLLIDES };
UrdfTree import_urdf(const std::string& path, UrdfUse use);
bool is_urdf(const std::string& path);

// Returns the frame of each link in the root's frame, all joints at zero.
std::vector<UrdfFrame> link_frames(const UrdfTree& tree);

// Returns what is wrong with a tree, "" if indices and sizes agree and all numbers can be simulated.
std::string what_is_wrong_with(const UrdfTree& tree);

}  // namespace frond
