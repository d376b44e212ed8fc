// In: springs and positions of the nodes. Out: their energy 1/2 k |p - target|^2, its force and stiffness; likewise of
// fibres, 1/2 k max(0, |p - q| - length)^2.
#include "solve/springs.hpp"

#include <algorithm>
#include <cmath>

namespace frond {

bool springs_are_sound(const System& system, const std::vector<Spring>& springs) {
    for (const Spring& spring : springs) {
        if (!is_sound(spring.attachment, system.elements->node_count)) return false;
        if (!(spring.stiffness >= 0) || !std::isfinite(spring.stiffness) || !spring.target.allFinite()) return false;
    }
    return true;
}

double spring_energy(const std::vector<Spring>& springs, const VecX& x) {
    double energy = 0;
    for (const Spring& spring : springs)
        energy += 0.5 * spring.stiffness * (spring.target - attachment_place(spring.attachment, x)).squaredNorm();
    return energy;
}

void add_spring_force(const std::vector<Spring>& springs, const VecX& x, VecX& f) {
    for (const Spring& spring : springs)
        add_attachment_force(spring.attachment, x,
                             spring.stiffness * (spring.target - attachment_place(spring.attachment, x)), f);
}

void add_spring_stiffness(const std::vector<Spring>& springs, const VecX& x, Tangent tangent, double scale,
                          BlockMatrix& A) {
    for (const Spring& spring : springs) {
        add_attachment_stiffness(spring.attachment, x, scale * spring.stiffness, A);
        if (tangent == Tangent::positive) continue;
        const Vec3 force = spring.stiffness * (spring.target - attachment_place(spring.attachment, x));
        add_attachment_turning(spring.attachment, x, force, scale, A);
    }
}

static Vec3 way_along(const Fibre& fibre, const VecX& x) {
    return attachment_place(fibre.end, x) - attachment_place(fibre.begin, x);
}

double drawn(const Fibre& fibre, const VecX& x) {
    return way_along(fibre, x).norm() / fibre.length;
}

double fibre_energy(const Fibre& fibre, const VecX& x) {
    const double over = way_along(fibre, x).norm() - fibre.length;
    return over > 0 ? 0.5 * fibre.stiffness * over * over : 0;
}

// Returns the derivative of a taut fibre's pull by the way from its begin to its end [N/m].
static Mat3 stiffness_between_ends(const Fibre& fibre, const Vec3& way) {
    const double length = way.norm(), over = length - fibre.length;
    const Vec3 along = way / length;
    const Mat3 onto = along * along.transpose();
    return fibre.stiffness * (onto + over / length * (Mat3::Identity() - onto));
}

// Returns by how much the energy at `to` differs from that of the force and the stiffness at `from` [J].
static double error_of_linearization(const Fibre& fibre, const VecX& from, const VecX& to) {
    const Vec3 before = way_along(fibre, from), change = way_along(fibre, to) - before;
    const double over = before.norm() - fibre.length;
    if (!(over > 0)) return fibre_energy(fibre, to);
    const double first = fibre.stiffness * over * before.normalized().dot(change),
                 second = 0.5 * change.dot(stiffness_between_ends(fibre, before) * change);
    return std::abs(fibre_energy(fibre, to) - fibre_energy(fibre, from) - first - second);
}

double miss_of_fibres(const std::vector<Fibre>& fibres, const VecX& from, const VecX& to) {
    double miss = 0;
    for (const Fibre& fibre : fibres) miss += error_of_linearization(fibre, from, to);
    return miss;
}

void add_fibre_force(const Fibre& fibre, const VecX& x, VecX& f) {
    const Vec3 way = way_along(fibre, x);
    const double length = way.norm(), over = length - fibre.length;
    if (!(over > 0)) return;
    const Vec3 pull = fibre.stiffness * over / length * way;
    add_attachment_force(fibre.begin, x, pull, f);
    add_attachment_force(fibre.end, x, -pull, f);
}

void add_fibre_stiffness(const Fibre& fibre, const VecX& x, double scale, BlockMatrix& A) {
    for_each_fibre_block(fibre, x, scale, *A.pattern, [&](int slot, const Mat3& block) { A.block(slot) += block; });
}

void for_each_fibre_block(const Fibre& fibre, const VecX& x, double scale, const BlockPattern& pattern,
                          const std::function<void(int slot, const Mat3& block)>& add_block) {
    const Vec3 way = way_along(fibre, x);
    if (!(way.norm() > fibre.length)) return;
    const Mat3 stiffness = scale * stiffness_between_ends(fibre, way);
    // Both ends' nodes, each once.
    constexpr size_t MOST = 2 * size_t(Attachment::MOST);
    std::array<int, MOST> node;
    std::array<double, MOST> weight;
    size_t count = 0;
    const auto add = [&](const Attachment& end, double sign) {
        for (size_t k = 0; k < size_t(end.count); k++) {
            const size_t at = size_t(std::find(node.begin(), node.begin() + long(count), end.node[k]) - node.begin());
            if (at == count) {
                node[count] = end.node[k];
                weight[count++] = 0;
            }
            weight[at] += sign * end.weight[k];
        }
    };
    add(fibre.begin, -1);
    add(fibre.end, 1);
    for (size_t a = 0; a < count; a++)
        for (size_t b = 0; b <= a; b++) add_block(pattern.slot(node[a], node[b]), weight[a] * weight[b] * stiffness);
}

}  // namespace frond
