// In: nodes whose rotation is held in part, and a step's equations. Out: the equations in the free part.
//
// By the rotation vector p from where a guide was made, the rotations that it allows are a line through zero, p along
// the axis, or the plane across the axis. They are so by the node's own vector too if the guide was made in the
// modelled shape; else on a curve, along which a solve goes straight, so that its end is put back onto it. The held
// directions are eliminated, as held nodes are: no spring holds them, which would store energy or be stiff.
#include "solve/guides.hpp"

#include "mechanics/rotation.hpp"

namespace frond {

bool guides_are_sound(const System& system, const std::vector<Guide>& guides) {
    if (!guides.empty() && !system.row->moves_chain) return false;
    for (const Guide& guide : guides)
        if (guide.node < 0 || guide.node >= system.elements->node_count) return false;
    return true;
}

// Returns the rotation vector from where the guide was made.
static Vec3 turn_since(const Guide& guide, const Vec3& turn) {
    return rotation_vector<double>(Mat3(rotation_of<double>(turn) * rotation_of<double>(guide.made_at).transpose()));
}

Vec3 guided(const Guide& guide, const Vec3& turn) {
    const Vec3 since = turn_since(guide, turn), about = guide.axis.dot(since) * guide.axis;
    const Mat3 allowed = rotation_of<double>(guide.is_hinge ? about : Vec3(since - about));
    return wound_as(turn, rotation_vector<double>(Mat3(allowed * rotation_of<double>(guide.made_at))));
}

Mat3 held_part(const Guide& guide, const Vec3& turn) {
    if (guide.is_hinge) {
        const Vec3 free = (inverse_rate_matrix<double>(turn) * guide.axis).normalized();
        return Mat3::Identity() - free * free.transpose();
    }
    const Mat3 change = inverse_rate_matrix<double>(turn_since(guide, turn)) * rate_matrix<double>(turn);
    const Vec3 held = (change.transpose() * guide.axis).normalized();
    return held * held.transpose();
}

void look_at_guides(Workspace& w, const VecX& x) {
    w.held_parts.clear();
    for (const Guide& guide : w.guides) w.held_parts.push_back(held_part(guide, point(x, guide.node)));
}

int guide_of(const Workspace& w, int node) {
    for (size_t g = 0; g < w.guides.size(); ++g)
        if (w.guides[g].node == node && !w.held[size_t(node)]) return int(g);
    return -1;
}

void keep_free_parts(const Workspace& w, VecX& of_nodes) {
    for (size_t g = 0; g < w.guides.size(); ++g) {
        auto of_node = point(of_nodes, w.guides[g].node);
        of_node -= Vec3(w.held_parts[g] * of_node);
    }
}

void hold_parts(Workspace& w) {
    if (w.guides.empty()) return;
    const BlockPattern& pattern = *w.A.pattern;
    for (int j = 0; j < pattern.node_count; ++j)
        for (int k = pattern.start[size_t(j)]; k < pattern.start[size_t(j) + 1]; ++k) {
            const int i = pattern.row[size_t(k)], row = guide_of(w, i), column = guide_of(w, j);
            auto block = w.A.block(k);
            const double size = block.trace();
            if (row >= 0) block -= Mat3(w.held_parts[size_t(row)] * block);
            if (column >= 0) block -= Mat3(block * w.held_parts[size_t(column)]);
            if (i == j && row >= 0) block += size * w.held_parts[size_t(row)];
        }
}

}  // namespace frond
