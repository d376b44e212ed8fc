#include <gtest/gtest.h>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Cholesky>
#include "calibration/calibration.hpp"
#include "calibration/static_stiffness.hpp"
#include "calibration/sway.hpp"
#include "modelling/build.hpp"
#include "plant/plant.hpp"
#include "support/model_def.hpp"
#include "mechanics/tet_element.hpp"
#include "cage/tet_geometry.hpp"
namespace frond::test {
namespace proto {
using MatX = Eigen::MatrixXd;
MatX dense(const BlockMatrix& K) {
    const BlockPattern& p = *K.pattern;
    MatX out = MatX::Zero(3 * p.node_count, 3 * p.node_count);
    for (int j = 0; j < p.node_count; j++)
        for (int s = p.start[size_t(j)]; s < p.start[size_t(j) + 1]; s++) {
            const int i = p.row[size_t(s)];
            out.block<3, 3>(3 * i, 3 * j) = K.block(s);
            out.block<3, 3>(3 * j, 3 * i) = K.block(s).transpose();
        }
    return out;
}
void modes(const Model& model, const char* name, const MatX& K, const VecX& mass, const std::vector<uint8_t>& held, const std::vector<int>& organ) {
    std::vector<int> free;
    for (int i = 0; i < int(held.size()); i++)
        if (!held[size_t(i)])
            for (int a = 0; a < 3; a++) free.push_back(3 * i + a);
    MatX Kf(free.size(), free.size());
    for (size_t i = 0; i < free.size(); i++)
        for (size_t j = 0; j < free.size(); j++) Kf(Eigen::Index(i), Eigen::Index(j)) = K(free[i], free[j]);
    MatX C = Kf.ldlt().solve(MatX::Identity(Kf.rows(), Kf.rows()));
    VecX root(Eigen::Index(free.size()));
    for (size_t i = 0; i < free.size(); i++) root[Eigen::Index(i)] = std::sqrt(mass[free[i] / 3]);
    MatX A = root.asDiagonal() * C * root.asDiagonal();
    A = (0.5 * (A + A.transpose())).eval();
    Eigen::SelfAdjointEigenSolver<MatX> eig(A);
    printf("%s\n", name);
    for (int k = 0; k < 40; k++) {
        const Eigen::Index c = A.rows() - 1 - k;
        const VecX v = eig.eigenvectors().col(c);
        double px = 0, pz = 0;
        std::map<int, double> energy;
        for (size_t i = 0; i < free.size(); i++) {
            (free[i] % 3 == 0 ? px : free[i] % 3 == 2 ? pz : energy[-1]) += free[i] % 3 == 1 ? 0 : v[Eigen::Index(i)] * root[Eigen::Index(i)];
            energy[organ[size_t(free[i] / 3)]] += v[Eigen::Index(i)] * v[Eigen::Index(i)];
        }
        printf("%7.3f Hz  part x %5.1f z %5.1f %%  ", 1 / (2 * M_PI * std::sqrt(eig.eigenvalues()[c])), 100 * px * px / model.mass(), 100 * pz * pz / model.mass());
        for (int n = 0; n < 4; n++) {
            auto best = std::max_element(energy.begin(), energy.end(), [](auto& a, auto& b) { return a.second < b.second; });
            if (best->first >= 0) printf(" %s %.2f", model.organs[size_t(best->first)].name.c_str(), best->second);
            energy.erase(best);
        }
        printf("\n");
    }
}
TEST(Proto, Modes) {
    const std::string name = getenv("PLANT") ? getenv("PLANT") : "corn";
    const auto model = build_from_file(std::string(FROND_SOURCE_DIR) + "/models/" + name + "/" + name + ".obj", model_def());
    for (const frond_mechanics which : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL}) {
        ensure_rest_shape(*model, which, 1);
        const auto rods = make_system(model, which, FROND_MASS_LUMPED, 1);
        const Elements& re = elements_of(*rods);
        BlockMatrix Kr;
        Kr.set_pattern(re.pattern);
        Kr.set_zero();
        mechanics(which).add_stiffness(re, re.modelled, Tangent::exact, 1, Kr);
        std::vector<int> organ(size_t(re.node_count), 0);
        if (mechanics(which).moves_chain)
            for (size_t i = 0; i < model->chain.nodes.size(); i++) organ[2 * i] = std::max(0, model->chain.nodes[i].organ);
        else
            for (size_t e = 0; e < model->cage.tets.size(); e++)
                for (int n : model->cage.tets[e]) organ[size_t(n)] = std::max(organ[size_t(n)], model->cage.tet_organ[e]);
        MatX K = dense(Kr);
        if (!mechanics(which).moves_chain && getenv("BARS")) {
            const double cap = atof(getenv("BARS"));
            const Embedding& ce = model->chain_embedding;
            const TetElements& te = as_tets(re);
            for (size_t i = 0; i < model->chain.nodes.size(); i++) {
                const ChainNode& n = model->chain.nodes[i];
                if (n.parent < 0) continue;
                const Section& sec = model->sections[i];
                const double r2 = (sec.bending_wide() - sec.bending_thin()) / sec.stretching();
                const double r = std::sqrt(std::max(0.0, r2));
                if (r < 1e-3) continue;
                for (int bar = 0; bar < 4; bar++) {
 const double side = bar % 2 ? -1 : 1;
                    std::map<int, double> w[2];
                    Vec3 place[2];
                    const int ends[2] = {n.parent, int(i)};
                    for (int k = 0; k < 2; k++) {
                        // nearest tet of the organ
                        place[k] = model->chain.nodes[size_t(ends[k])].position + (bar > 1 && k ? -side : side) * r * sec.wide();
                        double best = -1e9;
                        size_t tet = size_t(ce.tet[size_t(ends[k])]);
                        std::array<double, 4> weights{};
                        for (size_t e = 0; e < model->cage.tets.size(); e++) {
                            if (model->cage.tet_organ[e] != n.organ) continue;
                            const auto wt = tet_weights(model->cage.nodes, model->cage.tets[e], place[k]);
                            const double least = *std::min_element(wt.begin(), wt.end());
                            if (least > best) best = least, tet = e, weights = wt;
                        }
                        for (size_t c = 0; c < 4; c++) w[k][model->cage.tets[tet][c]] += weights[c];
                    }
                    const Vec3 d = (place[1] - place[0]).normalized();
                    const double EA = std::min(0.5 * sec.stretching(), cap * sec.bending_thin() / (2 * r * r)), k = EA / (place[1] - place[0]).norm();
                    std::map<int, double> all;
                    for (auto& [a, x] : w[1]) all[a] += x;
                    for (auto& [a, x] : w[0]) all[a] -= x;
                    for (auto& [a, x] : all)
                        for (auto& [b, y] : all) K.block<3, 3>(3 * a, 3 * b) += k * x * y * d * d.transpose();
                }
            }
            (void)te;
        }
        modes(*model, mechanics(which).name, K, node_mass_of(*rods), still_nodes(*model, re, mechanics(which).moves_chain), organ);
    }
}
}  // namespace proto
}  // namespace frond::test
