// FCL's distance and collision between capsules, triangles and meshes.
#include "support/referee.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/distance.h>

#include "core/decompose.hpp"

namespace frond::test {

// Returns the transform of a capsule; FCL's capsules lie along z.
static fcl::Transform3d frame_of(const Capsule& capsule) {
    fcl::Transform3d frame = fcl::Transform3d::Identity();
    const Vec3 axis = capsule.end - capsule.begin;
    if (axis.squaredNorm() > 0) frame.linear() = turn_between(Vec3::UnitZ(), axis).toRotationMatrix();
    frame.translation() = 0.5 * (capsule.begin + capsule.end);
    return frame;
}

static fcl::Capsuled shape_of(const Capsule& capsule) {
    return fcl::Capsuled(capsule.radius, (capsule.end - capsule.begin).norm());
}

double referee_distance(const Capsule& a, const Capsule& b) {
    const fcl::Capsuled a_shape = shape_of(a), b_shape = shape_of(b);
    fcl::DistanceRequestd request;
    request.gjk_solver_type = fcl::GST_INDEP;
    fcl::DistanceResultd result;
    return fcl::distance(&a_shape, frame_of(a), &b_shape, frame_of(b), request, result);
}

bool referee_overlap(const Capsule& a, const Capsule& b) {
    const fcl::Capsuled a_shape = shape_of(a), b_shape = shape_of(b);
    fcl::CollisionRequestd request;
    request.gjk_solver_type = fcl::GST_INDEP;
    fcl::CollisionResultd result;
    return fcl::collide(&a_shape, frame_of(a), &b_shape, frame_of(b), request, result) > 0;
}

double referee_distance(const Capsule& a, const Corners& b) {
    double distance = 0;
    const bool apart = fcl::detail::GJKSolver_indep<double>().shapeTriangleDistance(shape_of(a), frame_of(a), b[0],
                                                                                    b[1], b[2], &distance);
    return apart ? distance : -1;
}

bool referee_overlap(const Capsule& a, const Corners& b) {
    return fcl::detail::GJKSolver_indep<double>().shapeTriangleIntersect(shape_of(a), frame_of(a), b[0], b[1], b[2]);
}

using Tree = fcl::BVHModel<fcl::OBBd>;

static Tree tree_of(const TriangleMesh& mesh) {
    std::vector<fcl::Triangle> triangles;
    for (const Triangle& t : mesh.triangles) triangles.emplace_back(size_t(t[0]), size_t(t[1]), size_t(t[2]));
    Tree tree;
    tree.beginModel();
    tree.addSubModel(mesh.points, triangles);
    tree.endModel();
    return tree;
}

static Corners corners_of(const TriangleMesh& mesh, int triangle) {
    const Triangle& t = mesh.triangles[size_t(triangle)];
    return {mesh.points[size_t(t[0])], mesh.points[size_t(t[1])], mesh.points[size_t(t[2])]};
}

// Returns the shortest translation that separates two triangles (separating axes): along a normal, across an edge of
// each, or in the plane of one across one of its edges.
static double way_apart(const Corners& a, const Corners& b) {
    std::vector<Vec3> axes;
    std::array<Vec3, 3> a_edges, b_edges;
    for (size_t k = 0; k < 3; ++k) {
        a_edges[k] = a[(k + 1) % 3] - a[k];
        b_edges[k] = b[(k + 1) % 3] - b[k];
    }
    const Vec3 a_normal = a_edges[0].cross(a_edges[1]), b_normal = b_edges[0].cross(b_edges[1]);
    axes = {a_normal, b_normal};
    for (size_t i = 0; i < 3; ++i) {
        axes.push_back(a_normal.cross(a_edges[i]));
        axes.push_back(b_normal.cross(b_edges[i]));
        for (size_t k = 0; k < 3; ++k) axes.push_back(a_edges[i].cross(b_edges[k]));
    }
    double least = INFINITY;
    for (const Vec3& axis : axes) {
        const double length = axis.norm();
        if (!(length > 1e-12 * (a_edges[0].squaredNorm() + b_edges[0].squaredNorm()))) continue;
        const double a0 = axis.dot(a[0]), a1 = axis.dot(a[1]), a2 = axis.dot(a[2]);
        const double b0 = axis.dot(b[0]), b1 = axis.dot(b[1]), b2 = axis.dot(b[2]);
        const double a_over_b = std::max({a0, a1, a2}) - std::min({b0, b1, b2});
        const double b_over_a = std::max({b0, b1, b2}) - std::min({a0, a1, a2});
        least = std::min(least, std::min(a_over_b, b_over_a) / length);
    }
    return std::max(least, 0.0);
}

MeshOverlap deepest_overlap(const TriangleMesh& a, const TriangleMesh& b) {
    const Tree a_tree = tree_of(a), b_tree = tree_of(b);
    fcl::CollisionRequestd request;
    request.num_max_contacts = a.triangles.size() * b.triangles.size();
    request.enable_contact = true;
    fcl::CollisionResultd result;
    fcl::collide(&a_tree, fcl::Transform3d::Identity(), &b_tree, fcl::Transform3d::Identity(), request, result);
    MeshOverlap overlap;
    overlap.pairs = int(result.numContacts());
    for (size_t k = 0; k < result.numContacts(); ++k) {
        const fcl::Contactd& contact = result.getContact(k);
        const double depth = way_apart(corners_of(a, int(contact.b1)), corners_of(b, int(contact.b2)));
        overlap.depth = std::max(overlap.depth, depth);
    }
    return overlap;
}

}  // namespace frond::test
