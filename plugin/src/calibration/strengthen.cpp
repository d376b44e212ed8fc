// A plant that its materials would not carry is made stiffer, organ by organ, until it stands. This is judged on the
// rods, whose balance under weight is known without a search: if they would topple, the organs that give way most are
// made as stiff as needed.
#include <algorithm>

#include "calibration/calibration.hpp"
#include "calibration/hidden_ribs.hpp"
#include "calibration/strengthen.hpp"
#include "calibration/sway.hpp"
#include "calibration/toppling.hpp"
#include "mechanics/rod_elements.hpp"

namespace frond {
namespace {

// Materials that Frond chose bear this many times their load before they give way, as petioles do (1.7 to 2.9: Langer
// and others 2021, doi 10.3389/fpls.2021.765605), so that a touch does not topple the plant. Moduli that the caller
// gave are used as they are.
constexpr double SAFETY = 1.7, SAFETY_OF_GIVEN = 1.02;

// An organ may turn this far under its own weight applied sideways, by linear theory; an upright column topples at
// 1.306.
constexpr double LARGEST_TURN = 1.2;  // [rad]

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

// Returns the largest mass that hangs on a capsule of each organ [kg].
std::vector<double> borne_masses(const Model& model) {
    std::vector<double> beyond = model.chain_mass, borne(model.organs.size(), 0.0);
    for (size_t i = beyond.size(); i-- > 0;) {
        const ChainNode& node = model.chain.nodes[i];
        double& most = borne[size_t(std::max(node.organ, 0))];
        most = std::max(most, beyond[i]);
        if (node.parent >= 0) beyond[size_t(node.parent)] += beyond[i];
    }
    return borne;
}

}  // namespace

void strengthen_rods(const Model& model, frond_mechanics which, const std::function<RodElements()>& make,
                     const std::vector<double>& safety, std::vector<double>& stiffer) {
    constexpr int MOST_ROUNDS = 300;  // each stiffens by 2 % at least, all by a factor of 380
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

// Finds by how much each organ has to be stiffer so that the plant stands.
static void find_stiffer(Model& model) {
    std::vector<double>& stiffer = model.organ_stiffer;
    const std::vector<double> turns = find_turns(model).organ;
    std::vector<double> safety;
    for (size_t o = 0; o < stiffer.size(); o++) {
        const bool given = model.organs[o].young_given;
        stiffer[o] = given ? 1 : std::max(1.0, turns[o] / LARGEST_TURN);
        safety.push_back(given ? SAFETY_OF_GIVEN : SAFETY);
    }
    strengthen_rods(
        model, FROND_MECHANICS_ROD, [&] { return make_rod_elements(model, FROND_MECHANICS_ROD); }, safety, stiffer);
}

WeakOrgan strengthen(Model& model) {
    const std::vector<double>& stiffer = model.organ_stiffer;
    find_stiffer(model);
    // Ribs are looked for before tissue is made stiffer: those that weight needs, then thicker ones, since what it does
    // beside bending counts, too.
    constexpr int ROUNDS = 3;
    constexpr double VARIES = 3;  // factor by which tissue of one kind differs: no rib is needed to explain it [-]
    std::vector<double> load(stiffer.size(), 0.0);
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t o = 0; o < load.size(); o++)
            if (stiffer[o] > (load[o] > 0 ? 1 : VARIES)) load[o] = std::max(1.0, load[o] * stiffer[o]);
        if (!grow_hidden_ribs(model, load, LARGEST_TURN / SAFETY)) break;
        find_stiffer(model);
        if (std::all_of(stiffer.begin(), stiffer.end(), [](double factor) { return factor <= 1; })) break;
    }

    // Organs that carry next to nothing, silk and hairs, are not reported; a thin petiole carries its leaf.
    constexpr double WORTH_A_WORD = 0.02;  // share of the plant's mass [-]
    const std::vector<double> borne = borne_masses(model);
    WeakOrgan weak;
    for (size_t o = 0; o < stiffer.size(); o++)
        if (borne[o] >= WORTH_A_WORD * model.mass() && stiffer[o] > weak.factor)
            weak = {model.organs[o].name, model.organs[o].kind, stiffer[o]};
    return weak;
}

}  // namespace frond
