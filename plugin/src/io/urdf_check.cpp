// Checks a tree of links: numbers that cannot be simulated, which urdfdom accepts, give an error text with the link's
// name.
#include <cmath>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "io/urdf.hpp"
#include "section/section.hpp"

namespace frond {

static constexpr double LARGEST = 1e6;  // largest number allowed [m], [kg], [N] ...

static bool is_usable(const UrdfFrame& frame) {
    return frame.origin.allFinite() && frame.origin.cwiseAbs().maxCoeff() <= LARGEST &&
           frame.turn.coeffs().allFinite() && std::abs(frame.turn.norm() - 1) < 1e-6;
}

// Returns how many of a shape's sizes must be above zero.
static int size_count(UrdfKind kind) {
    switch (kind) {
        case UrdfKind::SPHERE:
            return 1;
        case UrdfKind::CYLINDER:
        case UrdfKind::CAPSULE:
            return 2;
        default:
            return 3;
    }
}

static std::string what_is_wrong_with(const UrdfTree& tree, const UrdfLink& link, const UrdfShape& shape) {
    const char* name = link.name.c_str();
    if (!is_usable(shape.frame))
        return text_of("link \"%.64s\": the place of a shape is not finite or too far off", name);
    for (int i = 0; i < size_count(shape.kind); ++i) {
        const double size = shape.kind == UrdfKind::MESH ? std::abs(shape.size[i]) : shape.size[i];
        if (!(size > 0 && size <= LARGEST))
            return text_of("link \"%.64s\": a shape has the size %g; sizes are in metres, above 0", name,
                           shape.size[i]);
    }
    if (shape.mesh < -1 || shape.mesh >= int(tree.meshes.size()))
        return text_of("link \"%.64s\" has no such mesh", name);
    for (float channel : shape.color)
        if (!(channel >= 0 && channel <= 1)) return text_of("link \"%.64s\": a colour is not in 0..1", name);
    return "";
}

static std::string what_is_wrong_with(const UrdfLink& link) {
    const char* name = link.name.c_str();
    if (!is_usable(link.frame)) return text_of("link \"%.64s\": its joint's origin is not finite or too far off", name);
    if (!(std::abs(link.axis.norm() - 1) < 1e-6))
        return text_of("link \"%.64s\": its joint's axis has no length", name);
    for (double value : {link.lower, link.upper})
        if (!(std::abs(value) <= LARGEST)) return text_of("link \"%.64s\": a limit of its joint is %g", name, value);
    for (double value : {link.effort, link.speed})
        if (!(value >= 0)) return text_of("link \"%.64s\": effort or velocity of its joint is %g", name, value);
    const bool is_limited = link.joint == UrdfJoint::REVOLUTE || link.joint == UrdfJoint::PRISMATIC;
    if (is_limited && link.lower > link.upper)
        return text_of("link \"%.64s\": its joint's limits are %g and %g; the lower one comes first", name, link.lower,
                       link.upper);
    if (!(link.mass >= 0 && link.mass <= LARGEST))
        return text_of("link \"%.64s\": its mass is %g kg; give one of 0 .. 1e6", name, link.mass);
    for (double value : {link.section_mass, link.stretching, link.twisting, link.bending_x, link.bending_y})
        if (!(value >= 0 && value < 1e15)) return text_of("link \"%.64s\": its section has the number %g", name, value);
    if (!(std::abs(link.taper) <= LARGEST_TAPER))
        return text_of("link \"%.64s\": its section has a taper of %g", name, link.taper);
    if (!is_usable(link.centre))
        return text_of("link \"%.64s\": its centre of mass is not finite or too far off", name);
    for (int axis = 0; axis < 3; ++axis)
        if (!link.inertia.allFinite() || link.inertia.cwiseAbs().maxCoeff() > LARGEST || link.inertia(axis, axis) < 0)
            return text_of("link \"%.64s\": its inertia is not finite or below zero", name);
    return "";
}

static bool is_usable(const UrdfMesh& mesh) {
    for (const Vec3& place : mesh.positions)
        if (!place.allFinite() || place.cwiseAbs().maxCoeff() > LARGEST_COORDINATE) return false;
    for (const Triangle& triangle : mesh.triangles)
        for (int corner : triangle)
            if (corner < 0 || size_t(corner) >= mesh.positions.size()) return false;
    return !mesh.triangles.empty();
}

std::string what_is_wrong_with(const UrdfTree& tree) {
    if (tree.links.empty()) return "it has no links";
    for (size_t i = 0; i < tree.links.size(); ++i) {
        const UrdfLink& link = tree.links[i];
        if (i == 0 ? link.parent != -1 : link.parent < 0 || size_t(link.parent) >= i)
            return text_of("link \"%.64s\" does not come after its parent", link.name.c_str());
        std::string wrong = what_is_wrong_with(link);
        for (const std::vector<UrdfShape>* shapes : {&link.visuals, &link.collisions})
            for (const UrdfShape& shape : *shapes)
                if (wrong.empty()) wrong = what_is_wrong_with(tree, link, shape);
        if (!wrong.empty()) return wrong;
    }
    for (const UrdfMesh& mesh : tree.meshes)
        if (!is_usable(mesh))
            return text_of("the mesh %.256s has no triangles, or places that are not finite", mesh.name.c_str());
    return "";
}

std::vector<UrdfFrame> link_frames(const UrdfTree& tree) {
    std::vector<UrdfFrame> frames;
    for (const UrdfLink& link : tree.links)
        frames.push_back(link.parent < 0 ? link.frame : frames[size_t(link.parent)] * link.frame);
    return frames;
}

}  // namespace frond
