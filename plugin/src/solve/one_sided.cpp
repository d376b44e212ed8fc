// In: W and b of one-sided rows. Out: the p >= 0 that minimises p'Wp/2 - b'p, by active sets (Lawson, Hanson 1974,
// "Solving least squares problems", chapter 23): rows that pull are solved as equations; rows that would push leave on
// the way to that, then violated ones join. In the first rounds all of them join at once, which is quick and mostly
// enough; then one by one, which reduces the objective in each round, so that it ends.
#include "solve/one_sided.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "core/assert.hpp"

namespace frond {

namespace {

// Moves p towards the solution on the rows that pull, as far as none pushes; rows that would push leave. Returns false
// if there is no solution.
bool solve_on(const Eigen::MatrixXd& W, const VecX& b, std::vector<Eigen::Index>& pulling, VecX& p) {
    while (true) {
        const Eigen::LLT<Eigen::MatrixXd> factor(W(pulling, pulling));
        if (factor.info() != Eigen::Success) return false;
        const VecX found = factor.solve(VecX(b(pulling))), now = p(pulling);
        double share = 1;
        for (Eigen::Index k = 0; k < found.size(); k++)
            if (!(found[k] > 0)) share = std::min(share, now[k] / (now[k] - found[k]));
        if (!(share >= 0)) share = 0;  // both are zero
        p(pulling) = VecX(now + share * (found - now));
        if (share == 1) return p.allFinite();
        std::vector<Eigen::Index> left;
        for (Eigen::Index k = 0; k < found.size(); k++) {
            const Eigen::Index row = pulling[size_t(k)];
            if (found[k] > 0 || p[row] > 1e-12 * now[k])
                left.push_back(row);
            else
                p[row] = 0;
        }
        if (left.size() == pulling.size()) return false;
        pulling = left;
    }
}

}  // namespace

bool solve_one_sided(const Eigen::MatrixXd& W, const VecX& b, VecX& p) {
    constexpr int EAGER = 6;  // rounds in which all violated rows join
    const Eigen::Index count = b.size();
    FROND_ASSERT(W.rows() == count && W.cols() == count);
    const double rounding = 1e-9 * (count > 0 ? b.cwiseAbs().maxCoeff() : 0);
    std::vector<Eigen::Index> pulling;
    p.setZero(count);
    for (int round = 0; round < EAGER + 3 * int(count); round++) {
        const VecX lacking = b - W * p;
        std::vector<Eigen::Index> violated;
        for (Eigen::Index i = 0; i < count; i++)
            if (!(lacking[i] <= rounding) && std::find(pulling.begin(), pulling.end(), i) == pulling.end())
                violated.push_back(i);
        if (violated.empty()) {
            FROND_ASSERT(count == 0 || p.minCoeff() >= 0);
            return true;
        }
        if (round >= EAGER) {
            const auto is_less = [&](Eigen::Index i, Eigen::Index k) { return lacking[i] < lacking[k]; };
            violated = {*std::max_element(violated.begin(), violated.end(), is_less)};
        }
        pulling.insert(pulling.end(), violated.begin(), violated.end());
        if (!solve_on(W, b, pulling, p)) break;
    }
    p.setZero(count);
    return false;
}

}  // namespace frond
