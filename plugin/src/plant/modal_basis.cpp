// In: a model's rods, and their segments in the air. Out: their first two modes and how air drives them.
//
// Modes are those of the exact stiffness under weight (calibration/sway_find.cpp). Air that passes a plant as modelled
// at a velocity u presses a mode by rho |u| sum e_a^2 push_a . u, e being u's direction: pressures grow with the square
// of the speed and are known along the axes.
#include "calibration/static_stiffness.hpp"
#include "calibration/sway.hpp"
#include "plant/modal.hpp"
#include "solve/solve.hpp"

namespace frond {

namespace {

// Returns the columns axis, thin, wide in the modelled shape.
Mat3 frame_of(const AirPiece& piece, const Vec3& chord) {
    Mat3 frame;
    frame.col(0) = chord.normalized();
    const Vec3 across = piece.wide - frame.col(0) * frame.col(0).dot(piece.wide);
    frame.col(2) = across.norm() > 1e-9 ? Vec3(across.normalized()) : frame.col(0).unitOrthogonal();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

// Adds a segment's drag along each axis, half of it at either end.
void add_air(const Model& model, const AirPiece& piece, ModalBasis& all, double& weight) {
    constexpr double SPEED = 5;  // speed at which Reynolds numbers are taken [m/s]
    const int ends[2] = {model.chain.nodes[size_t(piece.node)].parent, piece.node};
    const Vec3 a = model.chain.nodes[size_t(ends[0])].position, b = model.chain.nodes[size_t(ends[1])].position;
    if (!((b - a).norm() > 1e-9)) return;
    const Mat3 frame = frame_of(piece, b - a);
    for (int axis = 0; axis < 3; axis++) {
        const Mat3 half = 0.5 / SPEED * air_resistance(piece, frame, SPEED * Vec3::Unit(axis), 1);
        for (NaturalMode& mode : all.modes) {
            if (mode.shape.size() == 0) continue;
            for (int end : ends) {
                const Vec3 move = point(mode.shape, 2 * end);
                mode.push[size_t(axis)] += half * move;
                mode.resist[size_t(axis)] += move.dot(half * move);
            }
        }
        all.middle += half.trace() * (a + b);
        weight += 2 * half.trace();
    }
}

void measure(const System& rods, NaturalMode& mode) {
    const Elements& elements = elements_of(rods);
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    BlockMatrix K, D;
    K.set_pattern(elements.pattern);
    D.set_pattern(elements.pattern);
    K.set_zero();
    D.set_zero();
    VecX force = VecX::Zero(elements.modelled.size()), product;
    row.add_force_stiffness_and_damping(elements, elements.modelled, elements.damping_ratio, force, K, D);
    K.multiply(mode.shape, product);
    mode.stiffness = mode.shape.dot(product);
    D.multiply(mode.shape, product);
    mode.ratio = mode.shape.dot(product);
    for (int i = 0; i < elements.node_count; i += 2) mode.reach = std::max(mode.reach, point(mode.shape, i).norm());
}

}  // namespace

ModalBasis make_modal_basis(const System& rods, const AirPieces& pieces) {
    const Elements& elements = elements_of(rods);
    const Model& model = model_of(rods);
    const std::vector<uint8_t> still = still_nodes(model, elements, true);
    StaticStiffness stiffness(elements.pattern);
    ModalBasis all;
    if (!stiffness.set(elements, still, FROND_MECHANICS_ROD, Tangent::exact, elements.modelled) &&
        !stiffness.set(elements, still, FROND_MECHANICS_ROD, Tangent::positive, elements.modelled))
        return all;
    const std::array<Sway, 2> sways = first_sways(stiffness.factor, node_mass_of(rods), still);
    for (size_t k = 0; k < 2; k++) {
        if (sways[k].shape.size() == 0) continue;
        all.modes[k].shape = sways[k].shape;
        all.modes[k].square = sways[k].square;
        measure(rods, all.modes[k]);
    }
    double weight = 0;
    for (const AirPiece& piece : pieces) add_air(model, piece, all, weight);
    if (weight > 0)
        all.middle /= weight;
    else
        all.middle = 0.5 * (model.surface.lower() + model.surface.upper());
    return all;
}

}  // namespace frond
