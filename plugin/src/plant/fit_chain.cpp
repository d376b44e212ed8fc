// In: target positions of the cage nodes. Out: positions and rotations of the chain, by rigid fits to begin with and
// then by Gauss-Newton on the sum of squared distances.
#include "mechanics/rotation.hpp"
#include "plant/follow.hpp"
#include "solve/block_factor.hpp"

namespace frond {

namespace {

// Normal equations of the attachments, with a weak pull towards no change for nodes that the cage nodes leave
// undetermined.
struct Normal {
    BlockPattern pattern;
    BlockPlan plan;
    BlockFactor factor;
    BlockMatrix A;
    std::vector<double> weight;  // weights of no change, one per node of the mechanics

    Normal(const Follow& follow, Eigen::Index size) {
        std::vector<Tet> pairs;
        double reach = 0;
        for (const Attachment& attachment : follow.attachments) {
            const int a = attachment.node[0], b = attachment.count > 1 ? attachment.node[1] : a;
            pairs.push_back({a, a + 1, b, b + 1});
            reach = std::max(reach, attachment.arm[0].norm());
        }
        pattern = make_block_pattern(int(size / 3), pairs);
        plan = make_block_plan(pattern);
        factor.plan = &plan;
        A.set_pattern(pattern);
        constexpr double WEAK = 1e-9;  // weight that holds what no cage node determines [-]
        for (int i = 0; i < pattern.node_count; i++) weight.push_back(i % 2 ? WEAK * reach * reach + 1e-30 : WEAK);
    }
    // Factorizes for the attachments at x.
    bool set(const Follow& follow, const VecX& x) {
        A.set_zero();
        for (const Attachment& attachment : follow.attachments) add_attachment_stiffness(attachment, x, 1, A);
        for (int i = 0; i < pattern.node_count; i++)
            A.block(pattern.start[size_t(i)]).diagonal().array() += weight[size_t(i)];
        return factorize(factor, A);
    }
};

// Moves each chain node with the cage nodes around it; where these do not determine that, with its parent.
void begin_rigid(const Follow& follow, const Model& model, const VecX& cage_x, VecX& x) {
    const size_t count = model.chain.nodes.size();
    std::vector<std::vector<Vec3>> from(count), to(count);
    for (size_t n = 0; n < follow.attachments.size(); n++) {
        const Attachment& attachment = follow.attachments[n];
        for (size_t k = 0; k < size_t(attachment.count); k++) {
            from[size_t(attachment.node[k]) / 2].push_back(point(follow.modelled, int(n)));
            to[size_t(attachment.node[k]) / 2].push_back(point(cage_x, int(n)));
        }
    }
    // A root that too few nodes determine moves with the whole cage.
    std::vector<Vec3> all_from, all_to;
    for (size_t i = 0; i < count; i++) {
        all_from.insert(all_from.end(), from[i].begin(), from[i].end());
        all_to.insert(all_to.end(), to[i].begin(), to[i].end());
    }
    Mat3 whole = Mat3::Identity();
    Vec3 shift = Vec3::Zero();
    fit_rigid(all_from, all_to, Vec3::Zero(), whole, shift);
    std::vector<Mat3> rotations(count, whole);
    for (size_t i = 0; i < count; i++) {
        const ChainNode& node = model.chain.nodes[i];
        Vec3 image = whole * node.position + shift;
        if (!fit_rigid(from[i], to[i], node.position, rotations[i], image) && node.parent >= 0) {
            const size_t parent = size_t(node.parent);
            rotations[i] = rotations[parent];
            image = point(x, int(2 * parent)) + rotations[i] * (node.position - model.chain.nodes[parent].position);
        }
        point(x, int(2 * i)) = image;
        point(x, int(2 * i + 1)) = rotation_vector<double>(rotations[i]);
    }
}

}  // namespace

void fit_chain(const Follow& follow, const Model& model, const VecX& cage_x, VecX& x) {
    constexpr int ROUNDS = 12;  // of Gauss-Newton, which keeps the best of them
    Normal normal(follow, x.size());
    begin_rigid(follow, model, cage_x, x);
    VecX places, best = x;
    double least = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        follow_places(follow, x, places);
        const double off = (cage_x - places).squaredNorm();
        if (off < least) best = x;
        if (!(off < 0.99 * least) || off == 0) break;
        least = off;
        if (!normal.set(follow, x)) break;
        VecX pull = VecX::Zero(x.size()), move;
        for (size_t n = 0; n < follow.attachments.size(); n++)
            add_attachment_force(follow.attachments[n], x, point(cage_x, int(n)) - point(places, int(n)), pull);
        solve(normal.factor, pull, move);
        if (!move.allFinite()) break;
        x += move;
    }
    x = best;
}

void fit_velocities(const Follow& follow, const VecX& x, const VecX& cage_v, VecX& v) {
    Normal normal(follow, x.size());
    v.setZero(x.size());
    if (!normal.set(follow, x)) return;
    VecX pull = VecX::Zero(x.size());
    for (size_t n = 0; n < follow.attachments.size(); n++)
        add_attachment_force(follow.attachments[n], x, point(cage_v, int(n)), pull);
    solve(normal.factor, pull, v);
}

}  // namespace frond
