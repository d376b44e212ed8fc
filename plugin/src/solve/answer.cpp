// In: a step that was just taken, and a few nodes. Out: how velocities at one push answer to impulses at another.
#include "solve/answer.hpp"

#include <algorithm>

#include "solve/integrator.hpp"

namespace frond {

bool make_answer(Workspace& workspace, const SolveSettings& settings, const std::vector<NodeBlock>& pushes,
                 Answer& answer) {
    std::vector<NodeBlock> free;
    for (const NodeBlock& push : pushes)
        if (!workspace.held[size_t(push.node)]) free.push_back(push);
    const LinearSolver& solver = linear_solver(settings.linear_solver);
    if (solver.half && !answers_by_mass(workspace, settings)) {
        solver.half(workspace.linear, free, answer);
        return answer.right.allFinite();
    }

    // Whole solves, direction by direction.
    std::sort(free.begin(), free.end(), [](const NodeBlock& a, const NodeBlock& b) { return a.node < b.node; });
    answer.rows.clear();
    answer.left.resize(3, 3 * Eigen::Index(free.size()));
    for (const NodeBlock& push : free)
        for (int r = 0; r < 3; ++r) {
            answer.left.col(Eigen::Index(answer.rows.size())) = push.block.row(r).transpose();
            answer.rows.push_back(3 * push.node + r);
        }
    const Eigen::Index n = 3 * Eigen::Index(workspace.held.size());
    answer.right.resize(3, n);
    VecX impulse(n), velocity;
    for (int axis = 0; axis < 3; ++axis) {
        impulse.setZero();
        for (const NodeBlock& push : free) point(impulse, push.node) += push.block.col(axis);
        if (!respond(workspace, settings, impulse, velocity)) return false;
        answer.right.row(axis) = velocity.transpose();
    }
    return true;
}

void add_coupling(const std::vector<const Answer*>& answers, std::vector<Mat3>& blocks) {
    const size_t count = answers.size();
    int most = 0;
    for (const Answer* answer : answers)
        if (!answer->rows.empty()) most = std::max(most, answer->rows.back() + 1);
    Eigen::Matrix3Xd spread = Eigen::Matrix3Xd::Zero(3, most);
    for (size_t j = 0; j < count; ++j) {
        const Answer& by = *answers[j];
        const bool whole = by.right.cols() != Eigen::Index(by.rows.size());
        if (whole)
            spread = by.right.leftCols(most);
        else
            for (size_t k = 0; k < by.rows.size(); ++k) spread.col(by.rows[k]) = by.right.col(Eigen::Index(k));
        // Symmetric: the other half is this one's mirror image.
        for (size_t i = 0; i <= j; ++i) {
            const Answer& at = *answers[i];
            Mat3 block = Mat3::Zero();
            for (size_t k = 0; k < at.rows.size(); ++k)
                block += at.left.col(Eigen::Index(k)) * spread.col(at.rows[k]).transpose();
            blocks[i * count + j] += block;
            if (i != j) blocks[j * count + i] += block.transpose();
        }
        if (!whole)
            for (const int row : by.rows) spread.col(row).setZero();
    }
}

}  // namespace frond
