// In: a step just taken, and a few nodes. Out: their compliance, velocities at one push by impulses at another.
#include "solve/node_compliance.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "core/lanes.hpp"
#include "solve/guides.hpp"
#include "solve/integrator.hpp"

namespace frond {

bool make_compliance(Workspace& workspace, const SolveSettings& settings, const std::vector<NodeBlock>& pushes,
                     NodeCompliance& compliance) {
    std::vector<NodeBlock> free;
    for (const NodeBlock& push : pushes) {
        FROND_ASSERT(push.node >= 0 && size_t(push.node) < workspace.held.size());
        if (workspace.held[size_t(push.node)]) continue;
        free.push_back(push);
        const int guide = guide_of(workspace, push.node);
        if (guide >= 0) free.back().block -= Mat3(workspace.held_parts[size_t(guide)] * push.block);
    }
    if (!responds_by_mass(workspace, settings)) {
        if (!make_factor(workspace.A, workspace.linear)) return false;
        half_solve(workspace.linear.block, free, compliance);
        return compliance.right.allFinite();
    }

    // A diagonal matrix has no half of a solve.
    std::sort(free.begin(), free.end(), [](const NodeBlock& a, const NodeBlock& b) { return a.node < b.node; });
    compliance.rows.clear();
    compliance.left.setZero(4, 3 * Eigen::Index(free.size()));
    for (const NodeBlock& push : free)
        for (int r = 0; r < 3; ++r) {
            compliance.left.col(Eigen::Index(compliance.rows.size())).head<3>() = push.block.row(r).transpose();
            compliance.rows.push_back(3 * push.node + r);
        }
    const Eigen::Index n = 3 * Eigen::Index(workspace.held.size());
    compliance.right.setZero(4, n);
    VecX impulse(n), velocity;
    for (int axis = 0; axis < 3; ++axis) {
        impulse.setZero();
        for (const NodeBlock& push : free) point(impulse, push.node) += push.block.col(axis);
        if (!respond(workspace, settings, impulse, velocity)) return false;
        compliance.right.row(axis) = velocity.transpose();
    }
    return true;
}

namespace {

// Sums the products of rows that both have.
struct AddCompliances {
    const std::vector<const NodeCompliance*>& at;
    const double* right;  // of all rows
    std::vector<Mat3>& blocks;
    template <class S>
    FROND_INLINE void run() const {
        for (size_t i = 0; i < at.size(); ++i) {
            FourLanes sum[3] = {};
            const double* left = at[i]->left.data();
            for (const int row : at[i]->rows) {
                const FourLanes own = load<FourLanes>(left);
                const double* other = right + 4 * row;
                for (int c = 0; c < 3; ++c) sum[c] += own * other[c];
                left += 4;
            }
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) blocks[i](r, c) += sum[c][r];
        }
    }
};

}  // namespace

void add_compliances(const std::vector<const NodeCompliance*>& at, const NodeCompliance& by, Columns3& spread,
                     std::vector<Mat3>& blocks) {
    int most = 0;
    FROND_ASSERT(blocks.size() == at.size());
    for (const NodeCompliance* compliance : at)
        if (!compliance->rows.empty()) most = std::max(most, compliance->rows.back() + 1);
    const bool whole = by.right.cols() != Eigen::Index(by.rows.size());
    if (!whole) {
        if (!by.rows.empty()) most = std::max(most, by.rows.back() + 1);
        if (spread.cols() < most) spread.setZero(4, most);
        for (size_t k = 0; k < by.rows.size(); ++k) spread.col(by.rows[k]) = by.right.col(Eigen::Index(k));
    }
    run_in_lanes(AddCompliances{at, (whole ? by.right : spread).data(), blocks});
    if (!whole)
        for (const int row : by.rows) spread.col(row).setZero();
}

}  // namespace frond
