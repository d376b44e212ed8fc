// A plant that its materials would not carry is made stiffer, organ by organ, until it stands. This is judged on the
// rods, whose balance under weight is known without a search: if they would topple, the organs that give way most are
// made as stiff as needed.
#include <algorithm>
#include <cmath>

#include "calibration/calibration.hpp"
#include "calibration/strengthen.hpp"
#include "calibration/sway.hpp"
#include "calibration/toppling.hpp"
#include "calibration/weigh.hpp"
#include "core/elementary.hpp"
#include "mechanics/rod_elements.hpp"

namespace frond {
namespace {

// Materials that Frond chose bear this many times their load before they give way, as petioles do (1.7 to 2.9: Langer
// and others 2021, doi 10.3389/fpls.2021.765605), so that a touch does not topple the plant. Materials that the caller
// gave are used as they are.
constexpr double SAFETY = 1.7, SAFETY_OF_GIVEN = 1.02;

// An organ may turn this far under its own weight applied sideways, by linear theory; an upright column topples at
// 1.306.
constexpr double LARGEST_TURN = 1.2;  // [rad]

// Returns how far each organ turns from its base to its tip when all its weight pulls sideways, by linear theory [rad].
std::vector<double> organ_turns(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    const Weights weights = weigh(model, hang_tets(model));
    std::vector<double> turns(model.organs.size(), 0.0);
    for (int axis = 0; axis < 3; axis++) {
        const Vec3 load = GRAVITY * Vec3::Unit(axis);
        std::vector<Vec3> force(nodes.size()), moment(nodes.size());
        for (size_t i = 0; i < nodes.size(); i++) {
            force[i] = weights.mass[i] * load;
            moment[i] = weights.moment[i].cross(load);
        }
        std::vector<double> curvature(nodes.size(), 0.0), turn(nodes.size(), 0.0);
        for (size_t i = nodes.size(); i-- > 0;) {
            if (nodes[i].parent < 0) continue;
            const size_t parent = size_t(nodes[i].parent);
            const Section& section = model.sections[i];
            const Vec3 M = moment[i] - (0.5 * (nodes[i].position + nodes[parent].position)).cross(force[i]);
            curvature[i] = frond::hypot(M.dot(section.wide()) / section.bending_thin(),
                                        M.dot(section.thin) / section.bending_wide());
            force[parent] += force[i];
            moment[parent] += moment[i];
        }
        for (size_t i = 0; i < nodes.size(); i++) {
            if (nodes[i].parent < 0) continue;
            const size_t parent = size_t(nodes[i].parent), organ = size_t(nodes[i].organ);
            turn[i] =
                model.sections[i].length * curvature[i] + (nodes[parent].organ == nodes[i].organ ? turn[parent] : 0.0);
            turns[organ] = std::max(turns[organ], turn[i]);
        }
    }
    return turns;
}

// Rods of a plant that stands, with the stiffness that resists, in which each organ is weaker by its safety factor, and
// the stiffness that weight takes.
struct Standing {
    RodElements elements, weaker;
    std::vector<uint8_t> held;
    StaticStiffness resisting;
    BlockMatrix taken;  // G
    bool is_sound = false;

    Standing(const Model& model, RodElements rods, frond_mechanics which, const std::vector<double>& safety)
        : elements(std::move(rods)), weaker(elements), resisting(elements.pattern) {
        held = still_nodes(model, elements, true);
        taken.set_pattern(elements.pattern);
        take_by_weight(elements, mechanics(which), elements.modelled, taken);
        for (RodSegment& segment : weaker.segments) {
            const double s = safety[size_t(model.chain.nodes[size_t(segment.b)].organ)];
            segment.stretch /= s;
            segment.bend /= s;
        }
        is_sound = resisting.set(weaker, held, which, Tangent::positive, elements.modelled);
    }
};

// Adds move' K move with each rod's own stiffness K to its organ's work.
void add_work_of_rods(const Model& model, const RodElements& all, frond_mechanics which, const VecX& move,
                      std::vector<double>& work) {
    RodElements one;
    one.node_count = 4;
    one.pattern = make_block_pattern(4, std::vector<Tet>{{0, 1, 2, 3}});
    one.segments.resize(1);
    BlockMatrix K;
    K.set_pattern(one.pattern);
    VecX product;
    for (const RodSegment& segment : all.segments) {
        const auto ends = [&](const VecX& of) {
            VecX both(12);
            both << of.segment<6>(6 * segment.a), of.segment<6>(6 * segment.b);
            return both;
        };
        RodSegment& rod = one.segments.front();
        rod = segment;
        rod.a = 0;
        rod.b = 1;
        for (int r = 0; r < 4; r++)
            for (int c = 0; c < 4; c++) rod.slots[size_t(4 * r + c)] = one.pattern.slot(r, c);
        K.set_zero();
        mechanics(which).add_stiffness(one, ends(all.modelled), Tangent::positive, 1, K);
        const VecX own = ends(move);
        K.multiply(own, product);
        work[size_t(model.chain.nodes[size_t(segment.b)].organ)] += own.dot(product);
    }
}

std::vector<double> organ_masses(const Model& model) {
    std::vector<double> masses(model.organs.size(), 0.0);
    for (size_t i = 0; i < model.chain.nodes.size(); i++)
        masses[size_t(std::max(model.chain.nodes[i].organ, 0))] += model.chain_mass[i];
    return masses;
}

}  // namespace

void strengthen_rods(const Model& model, frond_mechanics which, const std::function<RodElements()>& make,
                     const std::vector<double>& safety, std::vector<double>& stiffer) {
    constexpr int MOST_ROUNDS = 300;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        Standing standing(model, make(), which, safety);
        if (!standing.is_sound) break;
        const Toppling toppling = find_toppling(standing.resisting, standing.taken, standing.held);
        if (!(toppling.overload > 1)) break;
        const std::vector<double> shares =
            find_shares(toppling, standing.resisting, standing.taken, standing.held, stiffer.size(),
                        [&](const VecX& move, std::vector<double>& work) {
                            add_work_of_rods(model, standing.weaker, which, move, work);
                        });
        const std::vector<double> factors = stiffer_by(shares, toppling.overload);
        for (size_t o = 0; o < stiffer.size(); o++) stiffer[o] *= factors[o];
    }
}

WeakOrgan strengthen(Model& model) {
    std::vector<double>& stiffer = model.organ_stiffer;
    const std::vector<double> turns = organ_turns(model);
    std::vector<double> safety;
    for (size_t o = 0; o < stiffer.size(); o++) {
        const bool given = model.organs[o].material_given;
        stiffer[o] = given ? 1 : std::max(1.0, turns[o] / LARGEST_TURN);
        safety.push_back(given ? SAFETY_OF_GIVEN : SAFETY);
    }
    strengthen_rods(
        model, FROND_MECHANICS_ROD, [&] { return make_rod_elements(model, FROND_MECHANICS_ROD); }, safety, stiffer);

    // Organs of negligible weight, silk and hairs, are not reported.
    constexpr double WORTH_A_WORD = 0.02;  // share of the plant's mass [-]
    const std::vector<double> masses = organ_masses(model);
    double whole = 0;
    for (double mass : masses) whole += mass;
    WeakOrgan weak;
    for (size_t o = 0; o < stiffer.size(); o++)
        if (masses[o] >= WORTH_A_WORD * whole && stiffer[o] > weak.factor) weak = {model.organs[o].name, stiffer[o]};
    return weak;
}

}  // namespace frond
