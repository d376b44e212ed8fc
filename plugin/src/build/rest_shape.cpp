// Rest shape: an artist's mesh shows a plant as it stands, bent by its own weight. Inverse statics finds the shape X
// without gravity from which weight bends it to the shape x that was modelled: elastic forces f(x; X) + weight = 0. To
// first order a move of X acts on f as the stiffness, so X <- X - K^-1 (f + weight) converges in a few rounds; the
// exact tangent at x then tells whether the plant stands there stably or would topple (Greenhill 1881).
#include <cmath>

#include "build/build.hpp"
#include "build/static_stiffness.hpp"
#include "core/log.hpp"

namespace frond {
namespace {

constexpr double GRAVITY = 9.81;  // along the model's -y [m/s^2]
constexpr int ROUNDS = 40;
constexpr double TOLERANCE = 1e-9;  // residual over weight [-]

VecX modelled_positions(const Model& model) {
    VecX x(3 * Eigen::Index(model.cage.nodes.size()));
    for (size_t i = 0; i < model.cage.nodes.size(); i++) point(x, int(i)) = model.cage.nodes[i];
    return x;
}

// Elastic force and weight at x, zero where the root holds; the weight's norm in `weight` [N].
VecX unbalanced_force(const Model& model, const TetElements& elements, frond_mechanics which, const VecX& x,
                      double& weight) {
    VecX f = VecX::Zero(x.size());
    for (size_t e = 0; e < elements.tets.size(); e++)
        for (int corner : elements.tets[e]) f[3 * corner + 1] -= GRAVITY * elements.density[e] * elements.volume[e] / 4;
    for (size_t i = 0; i < model.root.size(); i++)
        if (model.root[i]) point(f, int(i)).setZero();
    weight = f.norm();
    mechanics(which).add_force(elements, x, f);
    for (size_t i = 0; i < model.root.size(); i++)
        if (model.root[i]) point(f, int(i)).setZero();
    return f;
}

double signed_volume(const VecX& x, const Tet& tet) {
    const Vec3 a = point(x, tet[1]) - point(x, tet[0]), b = point(x, tet[2]) - point(x, tet[0]),
               c = point(x, tet[3]) - point(x, tet[0]);
    return a.cross(b).dot(c) / 6;
}

// The longest part of a move of the rest shape that keeps every tet above a third of its volume; 0 if none does.
double longest_move(const Model& model, const VecX& x, const VecX& rest, const VecX& move) {
    for (double share = 1; share > 0.01; share /= 2) {
        const VecX moved = rest + share * move;
        bool good = moved.allFinite();
        for (const Tet& tet : model.cage.tets) {
            if (!good) break;
            good = signed_volume(moved, tet) > signed_volume(x, tet) / 3;
        }
        if (good) return share;
    }
    return 0;
}

// The rest shape of one mechanics; empty if the material cannot carry the plant in the shape that was modelled.
VecX find_rest_shape(const Model& model, frond_mechanics which) {
    const VecX x = modelled_positions(model);
    VecX rest = x;
    double last_residual = INFINITY;
    std::unique_ptr<StaticStiffness> stiffness;
    TetElements elements = make_tet_elements(model, &rest);
    stiffness = std::make_unique<StaticStiffness>(elements.pattern);
    for (int round = 0; round < ROUNDS; round++) {
        double weight = 0;
        const VecX force = unbalanced_force(model, elements, which, x, weight);
        const double residual = weight > 0 ? force.norm() / weight : 0;
        if (residual < TOLERANCE || (residual < 1e-6 && residual > 0.5 * last_residual))
            return stiffness->set(elements, model.root, which, Tangent::exact, x) ? rest : VecX();
        last_residual = residual;
        if (!stiffness->set(elements, model.root, which, Tangent::positive, x)) return VecX();
        VecX move(x.size());
        solve(*stiffness->factor, force, move);
        const double share = longest_move(model, x, rest, -move);
        if (share == 0) return VecX();
        rest -= share * move;
        TetElements moved = make_tet_elements(model, &rest);
        moved.pattern = std::move(elements.pattern);  // the factor's matrix refers to it
        elements = std::move(moved);
        stiffness->K.pattern = &elements.pattern;
    }
    return VecX();
}

}  // namespace

void find_rest_shapes(Model& model) {
    // The default mechanics decides how stiff the plant has to be.
    constexpr double STIFFER = 1.5;
    constexpr int MOST_TRIES = 40;
    double factor = 1;
    VecX rest = find_rest_shape(model, FROND_TET_COROTATIONAL);
    for (int i = 0; i < MOST_TRIES && rest.size() == 0; i++) {
        factor *= STIFFER;
        for (double& young : model.tet_young) young *= STIFFER;
        rest = find_rest_shape(model, FROND_TET_COROTATIONAL);
    }
    model.stiffened *= factor;
    if (factor > 1)
        warn(
            "the plant cannot carry its own weight in the shape it was modelled in; its organs were made %.3g times "
            "stiffer. "
            "Check the scale (it is %.2f m high) and the materials",
            factor, model.surface.height());
    model.rest_positions[FROND_TET_COROTATIONAL] = rest;
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++)
        if (which != FROND_TET_COROTATIONAL)
            model.rest_positions[size_t(which)] = find_rest_shape(model, frond_mechanics(which));
}

}  // namespace frond
