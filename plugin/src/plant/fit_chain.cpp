// In: target positions of points that a chain carries. Out: positions and rotations of the chain, by rigid fits to
// begin with and then by Gauss-Newton on the sum of squared distances, damped where that leads astray (Levenberg 1944).
#include "mechanics/rotation.hpp"
#include "plant/follow.hpp"
#include "solve/block_factor.hpp"

namespace frond {

namespace {

constexpr double WEAK = 1e-9;  // weight that holds what no point determines, over that of one [-]

// Normal equations of the attachments, with a weak pull towards no change for nodes that the points leave
// undetermined.
struct Normal {
    BlockPattern pattern;
    BlockPlan plan;
    BlockFactor factor;
    BlockMatrix A;
    std::vector<double> weight;  // weights of no change, one per node of the mechanics

    Normal(const Carried& carried, Eigen::Index size) {
        std::vector<Tet> pairs;
        double reach = 0;
        for (const Attachment& attachment : carried.attachments) {
            const int a = attachment.node[0], b = attachment.count > 1 ? attachment.node[1] : a;
            pairs.push_back({a, a + 1, b, b + 1});
            reach = std::max(reach, attachment.arm[0].norm());
        }
        pattern = make_block_pattern(int(size / 3), pairs);
        plan = make_block_plan(pattern);
        factor.plan = &plan;
        A.set_pattern(pattern);
        for (int i = 0; i < pattern.node_count; i++) weight.push_back(i % 2 ? WEAK * reach * reach + 1e-30 : WEAK);
    }
    // Factorizes for the attachments at x. Damping pulls towards no change, over the weight of one point.
    bool set(const Carried& carried, const VecX& x, double damping = 0) {
        A.set_zero();
        for (const Attachment& attachment : carried.attachments) add_attachment_stiffness(attachment, x, 1, A);
        for (int i = 0; i < pattern.node_count; i++)
            A.block(pattern.start[size_t(i)]).diagonal().array() += (1 + damping / WEAK) * weight[size_t(i)];
        return factorize(factor, A);
    }
};

}  // namespace

// Moves each chain node with the points around it; where these do not determine that, with its parent.
void fit_chain_roughly(const Carried& carried, const Model& model, const VecX& cage_x, VecX& x) {
    const size_t count = model.chain.nodes.size();
    std::vector<std::vector<Vec3>> from(count), to(count);
    for (size_t n = 0; n < carried.attachments.size(); n++) {
        const Attachment& attachment = carried.attachments[n];
        for (size_t k = 0; k < size_t(attachment.count); k++) {
            from[size_t(attachment.node[k]) / 2].push_back(point(carried.modelled, int(n)));
            to[size_t(attachment.node[k]) / 2].push_back(point(cage_x, int(n)));
        }
    }
    // A root that too few points determine moves with all of them.
    std::vector<Vec3> all_from, all_to;
    for (size_t i = 0; i < count; i++) {
        all_from.insert(all_from.end(), from[i].begin(), from[i].end());
        all_to.insert(all_to.end(), to[i].begin(), to[i].end());
    }
    Mat3 whole = Mat3::Identity();
    Vec3 shift = Vec3::Zero();
    fit_rigid(all_from, all_to, Vec3::Zero(), whole, shift);
    // Turns that the points hardly determine, like those of a thin strand about itself, are the parent's.
    constexpr double PARENTS = 0.001;  // weight of its rotation, over that of the points [-]
    std::vector<Mat3> rotations(count, whole);
    for (size_t i = 0; i < count; i++) {
        const ChainNode& node = model.chain.nodes[i];
        Vec3 image = whole * node.position + shift;
        if (node.parent >= 0) {
            rotations[i] = rotations[size_t(node.parent)];
            image = point(x, 2 * node.parent) +
                    rotations[i] * (node.position - model.chain.nodes[size_t(node.parent)].position);
        }
        fit_rigid(from[i], to[i], node.position, rotations[i], image, PARENTS);
        point(x, int(2 * i)) = image;
        point(x, int(2 * i + 1)) = rotation_vector<double>(rotations[i]);
    }
}

void fit_chain(const Carried& carried, const Model& model, const VecX& cage_x, VecX& x) {
    constexpr int ROUNDS = 20;
    constexpr double FIRST = 1e-2, HARDER = 10;  // damping and the factor on it where a round does not help [-]
    Normal normal(carried, x.size());
    fit_chain_roughly(carried, model, cage_x, x);
    VecX places, move;
    follow_places(carried, x, places);
    double off = (cage_x - places).squaredNorm(), damping = 0;
    for (int round = 0; round < ROUNDS && off > 0; round++) {
        VecX pull = VecX::Zero(x.size()), next_places;
        for (size_t n = 0; n < carried.attachments.size(); n++)
            add_attachment_force(carried.attachments[n], x, point(cage_x, int(n)) - point(places, int(n)), pull);
        if (!normal.set(carried, x, damping)) return;
        solve(normal.factor, pull, move);
        if (!move.allFinite()) return;
        follow_places(carried, x + move, next_places);
        const double next = (cage_x - next_places).squaredNorm();
        if (!(next < off)) {
            damping = std::max(FIRST, HARDER * damping);
            continue;
        }
        damping /= HARDER;
        x += move;
        places = next_places;
        if (!(next < 0.99 * off)) return;
        off = next;
    }
}

void fit_velocities(const Carried& carried, const VecX& x, const VecX& cage_v, VecX& v, double damping) {
    Normal normal(carried, x.size());
    v.setZero(x.size());
    if (!normal.set(carried, x, damping)) return;
    VecX pull = VecX::Zero(x.size());
    for (size_t n = 0; n < carried.attachments.size(); n++)
        add_attachment_force(carried.attachments[n], x, point(cage_v, int(n)), pull);
    solve(normal.factor, pull, v);
}

}  // namespace frond
