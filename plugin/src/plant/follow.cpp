#include "plant/follow.hpp"

#include <cmath>

#include "core/decompose.hpp"
#include "mechanics/rotation.hpp"

namespace frond {

namespace {

// The nearest point on a capsule's axis.
struct Place {
    int node = -1;  // the capsule's second chain node
    double along = 0, distance = INFINITY;
};

Place place_on(const Chain& chain, int node, const Vec3& p) {
    const Vec3& end = chain.nodes[size_t(node)].position;
    const Vec3& begin = chain.nodes[size_t(chain.nodes[size_t(node)].parent)].position;
    const double square = (end - begin).squaredNorm();
    const double along = square > 0 ? (p - begin).dot(end - begin) / square : 1;
    const double inside = std::min(std::max(along, 0.0), 1.0);
    return {node, along, (p - begin - inside * (end - begin)).norm()};
}

Attachment rigid_attachment(const Chain& chain, int node, const Vec3& p) {
    return node_attachment(node, p - chain.nodes[size_t(node)].position);
}

Attachment smooth_attachment(const Chain& chain, const Place& place, const Vec3& p) {
    const int b = place.node, a = chain.nodes[size_t(b)].parent;
    const Vec3 begin = chain.nodes[size_t(a)].position, axis = chain.nodes[size_t(b)].position - begin;
    return centre_line_attachment(a, b, axis, place.along, p - begin - place.along * axis);
}

// Returns the organs of the tets around each cage node.
std::vector<std::vector<int>> node_organs(const Cage& cage, const TetNodes& nodes) {
    std::vector<std::vector<int>> organs(size_t(nodes.count()));
    for (size_t e = 0; e < cage.tets.size(); e++) {
        for (int corner : cage.tets[e]) organs[size_t(corner)].push_back(cage.tet_organ[e]);
        if (nodes.order == 1) continue;
        for (size_t k = 4; k < 10; k++) organs[size_t(nodes.of_tet[e][k])].push_back(cage.tet_organ[e]);
    }
    return organs;
}

Eigen::Matrix3Xd points_of(const std::vector<Vec3>& points) {
    Eigen::Matrix3Xd m(3, Eigen::Index(points.size()));
    for (size_t i = 0; i < points.size(); i++) m.col(Eigen::Index(i)) = points[i];
    return m;
}

}  // namespace

std::vector<int> nearest_capsules(const Model& model, const TetNodes& nodes, const VecX& modelled) {
    const Chain& chain = model.chain;
    const std::vector<std::vector<int>> organs = node_organs(model.cage, nodes);
    std::vector<std::vector<int>> capsules(model.organs.size());
    std::vector<int> all;
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        if (chain.nodes[i].parent < 0) continue;
        all.push_back(int(i));
        if (chain.nodes[i].organ >= 0) capsules[size_t(chain.nodes[i].organ)].push_back(int(i));
    }

    std::vector<int> nearest;
    for (size_t n = 0; n < organs.size(); n++) {
        const Vec3 p = point(modelled, int(n));
        Place best;
        const auto try_all = [&](const std::vector<int>& list) {
            for (int node : list) {
                const Place place = place_on(chain, node, p);
                if (place.distance < best.distance) best = place;
            }
        };
        for (int organ : organs[n]) try_all(capsules[size_t(organ)]);
        if (best.node < 0) try_all(all);
        nearest.push_back(best.node);
    }
    return nearest;
}

Follow make_follow(const Model& model, const TetNodes& nodes, const VecX& modelled) {
    const Chain& chain = model.chain;
    Follow follow;
    follow.modelled = modelled;
    follow.skin = make_skin(model);
    const std::vector<int> capsules = nearest_capsules(model, nodes, modelled);
    for (size_t n = 0; n < capsules.size(); n++) {
        const Vec3 p = point(modelled, int(n));
        if (capsules[n] < 0) {
            // The chain has only roots.
            size_t nearest = 0;
            for (size_t i = 1; i < chain.nodes.size(); i++)
                if ((chain.nodes[i].position - p).norm() < (chain.nodes[nearest].position - p).norm()) nearest = i;
            follow.nearest.push_back(int(nearest));
            follow.attachments.push_back(rigid_attachment(chain, int(nearest), p));
            continue;
        }
        const Place best = place_on(chain, capsules[n], p);
        const int before = chain.nodes[size_t(best.node)].parent;
        follow.nearest.push_back(best.along < 0.5 ? before : best.node);
        const bool inside = best.along > 0 && best.along < 1;
        follow.attachments.push_back(inside ? smooth_attachment(chain, best, p)
                                            : rigid_attachment(chain, follow.nearest.back(), p));
    }
    return follow;
}

void follow_places(const Carried& carried, const VecX& x, VecX& places) {
    std::vector<Mat3> rotations(size_t(x.size()) / 6);
    for (size_t i = 0; i < rotations.size(); i++) rotations[i] = rotation_of<double>(point(x, int(2 * i + 1)));
    places.resize(3 * Eigen::Index(carried.attachments.size()));
    for (size_t n = 0; n < carried.attachments.size(); n++) {
        const Attachment& attachment = carried.attachments[n];
        Vec3 place = Vec3::Zero();
        for (size_t k = 0; k < size_t(attachment.count); k++)
            place += attachment.weight[k] * point(x, attachment.node[k]) +
                     rotations[size_t(attachment.node[k]) / 2] * attachment.arm[k];
        point(places, int(n)) = place;
    }
}

void follow_velocities(const Carried& carried, const VecX& x, const VecX& v, VecX& velocities) {
    velocities.resize(3 * Eigen::Index(carried.attachments.size()));
    for (size_t n = 0; n < carried.attachments.size(); n++)
        point(velocities, int(n)) = attachment_velocity(carried.attachments[n], x, v);
}

bool fit_rigid(const std::vector<Vec3>& from, const std::vector<Vec3>& to, const Vec3& origin, Mat3& rotation,
               Vec3& image, double weight) {
    if (from.size() < 3) return false;
    const Eigen::Matrix3Xd a = points_of(from), b = points_of(to);
    const Vec3 from_middle = a.rowwise().mean(), to_middle = b.rowwise().mean();
    Mat3 spread = (b.colwise() - to_middle) * (a.colwise() - from_middle).transpose();
    if (weight > 0) spread += weight * (a.colwise() - from_middle).squaredNorm() * rotation;
    const SingularParts svd = singular_parts(spread);
    if (!(svd.values[1] > 1e-6 * svd.values[0])) return false;
    Mat3 sign = Mat3::Identity();
    sign(2, 2) = (svd.U * svd.V.transpose()).determinant() < 0 ? -1 : 1;
    rotation = svd.U * sign * svd.V.transpose();
    image = to_middle + rotation * (origin - from_middle);
    return true;
}

}  // namespace frond
