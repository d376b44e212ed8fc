// In: an organ's cage, alone, and its rods. Out: moduli of the tets with which the cage has the rods' compliance.
//
// A tet has two moduli: Young's, the same in all directions, and that of the grain along the organ's axis, which twist does
// not feel. First the whole: one factor each, so that the organ bends and twists as far as it should. Then place by
// place: under equal loads elastic energy is inversely proportional to modulus, so the ratio of energies, cage over rods,
// is the factor. Then tet by tet, because a lattice of one cell across is not equally stiff in all directions: Gauss-Newton
// rounds, each the least change of the moduli's logarithms after which all compliances match, within bounds, since tets
// that are much softer than those around them turn inside out.
#include "build/fit_moduli.hpp"

#include <algorithm>
#include <cmath>

#include "build/compliance.hpp"
#include "build/least_change.hpp"
#include "model/section.hpp"

namespace frond {
namespace {

// Grain over Young's modulus [-]. Pressed together, grain that is much stiffer than what it lies in buckles tet by tet: a stem's
// where it is bent as far as its length.
constexpr double LEAST_GRAIN = 0.001, MOST_GRAIN = 30, FIRST_GRAIN = 0.05;

constexpr int TWIST = TIP_MOMENT + 2;

// Stems that stand alone do. Sheets get none, as their cage is a hundred times as thick as they are and weight alone would
// buckle it; nor do organs that grow out of others or bear them, as whole plants then swayed by 5 to 16 % too fast or too
// slowly when let go. They twist as they may.
bool may_have_grain(const Model& plant, int organ) {
    if (is_sheet(plant.organs[size_t(organ)])) return false;
    const std::vector<ChainNode>& nodes = plant.chain.nodes;
    return std::none_of(nodes.begin(), nodes.end(), [&](const ChainNode& node) {
        const int below = node.parent >= 0 ? nodes[size_t(node.parent)].organ : node.organ;
        return below != node.organ && (below == organ || node.organ == organ);
    });
}

// An organ's cage in elements of one order, with its loads.
struct Bench {
    LoneOrgan& lone;
    const Compliance rods;
    TetElements elements;
    StaticStiffness stiffness;
    CageLoads loads;
    bool plain;  // without grain

    Bench(LoneOrgan& lone, const Compliance& rods, int order, bool plain)
        : lone(lone),
          rods(rods),
          elements(make_tet_elements(lone.model, nullptr, order)),
          stiffness(elements.pattern),
          plain(plain) {}
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;
    size_t tet_count() const { return lone.tets.size(); }
    // The grain keeps within what it may be beside the tet's modulus.
    void scale(size_t e, double bulk, double grain) {
        const double young = lone.model.tet_young[e] *= bulk;
        elements.mu[e] *= bulk;
        elements.lambda[e] *= bulk;
        if (plain) return;
        const double before = lone.model.tet_grain[e];
        lone.model.tet_grain[e] = std::clamp(grain * before, LEAST_GRAIN * young, MOST_GRAIN * young);
        elements.grain[e] *= lone.model.tet_grain[e] / before;
    }
    // Shares of tets, then of their grain if there is any.
    std::vector<Compliance> measure() {
        std::vector<Compliance> shares = cage_compliances(lone, elements, stiffness, loads);
        if (plain && !shares.empty()) shares.resize(tet_count());
        return shares;
    }
};

// Moduli with which a cage that reaches one edge beyond the organ has about its stiffness against bending and twist, less
// where the organ fills little of the tet.
void set_first_moduli(const Section& section, double stiffer, double edge, double fill, bool plain, Model& model,
                      size_t e) {
    const double thickness = section.thickness + edge, width = section.width + edge;
    const double less = stiffer * std::pow(fill, 0.25);
    const double along = less * 12 * section.bending_thin() / (std::pow(thickness, 3) * width);
    const double shear = less * section.twisting() / strip_torsion_constant(std::max(width, thickness), thickness);
    const double young = plain ? along : std::clamp(2 * (1 + model.tet_poisson[e]) * shear, along / MOST_GRAIN, along);
    model.tet_young[e] = young;
    model.tet_grain[e] = plain ? 0 : std::max(along - young, FIRST_GRAIN * young);
}

// ---- place by place ----------------------------------------------------------------------------------------------

// Places along an organ are not told apart more finely than its tets do: each chain node's first node of such a stretch.
std::vector<int> stretches(const Chain& chain, int organ, double length) {
    std::vector<int> first(chain.nodes.size());
    for (size_t i = 0; i < first.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        first[i] = int(i);
        if (node.organ != organ || node.parent < 0 || chain.nodes[size_t(node.parent)].organ != organ) continue;
        const int begin = first[size_t(node.parent)];
        if (node.distance - chain.nodes[size_t(begin)].distance < length) first[i] = begin;
    }
    return first;
}

// Energy of a share under a force at the tip and under weight, along the three axes together, each over what the rods
// have in all.
double energy_of(const Compliance& share, const Compliance& rods) {
    const auto trace = [](const Compliance& C, int first) { return C.diagonal().segment<3>(first).sum(); };
    return trace(share, TIP_FORCE) / trace(rods, TIP_FORCE) + trace(share, WEIGHT) / trace(rods, WEIGHT);
}
constexpr double WHOLE_ENERGY = 2;

// The place of each tet, and the energy that the rods have there.
struct Places {
    std::vector<int> of_tet;
    std::vector<double> wanted;  // one a chain node [-]
};

Places find_places(const LoneOrgan& lone, const Model& plant, const std::vector<int>& hangs,
                   const std::vector<Compliance>& rod_shares, const Compliance& rods) {
    constexpr double STRETCH = 1.5;  // of the mean edge [-]
    const std::vector<int> first = stretches(plant.chain, lone.organ, STRETCH * mean_edge(lone.model.cage));
    Places places;
    std::vector<char> has_tets(first.size(), 0);
    for (size_t e : lone.tets) {
        places.of_tet.push_back(first[size_t(hangs[e])]);
        has_tets[size_t(places.of_tet.back())] = 1;
    }
    // A rod's energy counts at the nearest place towards the base on which tets hang.
    const int home = int(std::find(has_tets.begin(), has_tets.end(), 1) - has_tets.begin());
    places.wanted.assign(first.size(), 0.0);
    for (size_t i = 0; i < first.size(); i++) {
        int node = first[i];
        while (node >= 0 && !has_tets[size_t(node)]) node = plant.chain.nodes[size_t(node)].parent;
        places.wanted[size_t(node >= 0 ? node : home)] += energy_of(rod_shares[i], rods);
    }
    return places;
}

// One factor for all tets' moduli and one for their grain, by Newton's method on the logarithms of energy and twist. Where
// there is no grain, places are enough.
bool fit_whole(Bench& bench) {
    if (bench.plain) return true;
    constexpr int ROUNDS = 5;
    constexpr double LARGEST_STEP = 2;  // of a logarithm [-]
    constexpr double RIGID = 0.02;      // what a change counts beside an error [-]
    const size_t tet_count = bench.tet_count();
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        Eigen::Matrix2d share = Eigen::Matrix2d::Zero();  // bending and twist, of bulk and of grain
        for (size_t k = 0; k < shares.size(); k++)
            share.col(k < tet_count ? 0 : 1) +=
                Eigen::Vector2d(energy_of(shares[k], bench.rods) / WHOLE_ENERGY,
                                shares[k](TWIST, TWIST) / bench.rods(TWIST, TWIST));
        const Eigen::Vector2d sum = share.rowwise().sum();
        if (!(sum.minCoeff() > 0)) return false;
        // A first round only brings the whole to the right order.
        Eigen::Vector2d step = Eigen::Vector2d::Constant(std::log(sum[0]));
        if (round > 0) {
            const Eigen::Matrix2d slope = sum.cwiseInverse().asDiagonal() * share;
            const Eigen::Matrix2d square = slope.transpose() * slope + RIGID * Eigen::Matrix2d::Identity();
            step = square.inverse() * slope.transpose() * sum.array().log().matrix();
            step = step.cwiseMax(-LARGEST_STEP).cwiseMin(LARGEST_STEP);
        }
        for (size_t e = 0; e < tet_count; e++) bench.scale(e, std::exp(step[0]), std::exp(step[1]));
    }
    return true;
}

bool fit_places(Bench& bench, const Places& places) {
    constexpr int ROUNDS = 3;
    constexpr double LARGEST_FACTOR = 1e6;         // of a modulus in a round [-]
    constexpr double SOFTEST = 0.5, STIFFEST = 8;  // of a place, over how it began [-]
    constexpr double BLUR = 0.3;                   // of the organ's energy that counts at each of its places [-]
    const size_t tet_count = places.of_tet.size();
    std::vector<double> local(tet_count, 1.0);
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        std::vector<double> cage(places.wanted.size(), 0.0);
        double sum = 0;
        for (size_t e = 0; e < tet_count; e++) {
            double energy = energy_of(shares[e], bench.rods);
            if (!bench.plain) energy += energy_of(shares[tet_count + e], bench.rods);
            cage[size_t(places.of_tet[e])] += energy;
            sum += energy;
        }
        if (!(sum > 0)) return false;
        const double whole = std::clamp(sum / WHOLE_ENERGY, 1 / LARGEST_FACTOR, LARGEST_FACTOR);
        for (size_t e = 0; e < tet_count; e++) {
            const size_t place = size_t(places.of_tet[e]);
            const double here = (cage[place] + BLUR * sum) / (places.wanted[place] + BLUR * WHOLE_ENERGY) / whole;
            const double before = local[e];
            if (round > 0) local[e] = std::clamp(before * here, SOFTEST, STIFFEST);
            const double factor = whole * local[e] / before;
            bench.scale(e, factor, factor);
        }
    }
    return true;
}

// ---- tet by tet --------------------------------------------------------------------------------------------------

bool is_moment(int load) {
    return load >= TIP_MOMENT && load < TIP_MOMENT + 3;
}

// In the first rounds moments pull along, in the last ones bending by forces comes first, where there is no grain alone, since
// twist is not to be had without.
struct Aim {
    bool plain, last;
};

// How much a load counts.
double weight_of(int load, Aim aim) {
    if (!is_moment(load)) return 1;
    if (load != TWIST) return aim.last ? 0.1 : 0.5;
    if (aim.plain) return aim.last ? 1e-3 : 0.5;
    return aim.last ? 0.3 : 1;
}

// A compliance much smaller than the largest of its kind is not told from nothing.
constexpr double FLOOR = 0.03;  // of that [-]

// Errors of a cage's compliance and their derivatives by the logarithms of the tets' moduli.
struct Errors {
    VecX value;
    MatX slope;
};

// Of a load with itself the error is the logarithm of the ratio, cage over rods; of two loads the difference of their
// correlations.
Errors errors_of(const std::vector<Compliance>& shares, const Compliance& rods, Aim aim) {
    constexpr double LARGE = 0.5;   // an error beyond which it counts less, because it may be beyond mending [-]
    using Sizes = Eigen::Matrix<double, LOAD_COUNT, 1>;
    const Compliance cage = sum_of(shares);
    Sizes floors;
    for (int first : {TIP_FORCE, TIP_MOMENT, MIDDLE_FORCE, WEIGHT})
        floors.segment<3>(first).setConstant(FLOOR * rods.diagonal().segment<3>(first).maxCoeff());
    const Sizes wanted = rods.diagonal() + floors, is = cage.diagonal() + floors;
    std::vector<std::array<int, 2>> pairs;
    for (int i = 0; i < LOAD_COUNT; i++)
        for (int j = i; j < LOAD_COUNT; j++)
            if (!(is_moment(i) && j >= MIDDLE_FORCE)) pairs.push_back({i, j});
    Errors errors;
    errors.value.resize(Eigen::Index(pairs.size()));
    errors.slope.resize(errors.value.size(), Eigen::Index(shares.size()));
    for (Eigen::Index k = 0; k < errors.value.size(); k++) {
        const auto [i, j] = pairs[size_t(k)];
        const double size = std::sqrt(is[i] * is[j]), alike = cage(i, j) / size;
        const double error = i == j ? std::log(is[i] / wanted[i])
                                    : alike - rods(i, j) / std::sqrt(wanted[i] * wanted[j]);
        const double counts =
            std::sqrt(weight_of(i, aim) * weight_of(j, aim) / (1 + error * error / (LARGE * LARGE)));
        errors.value[k] = counts * error;
        for (size_t e = 0; e < shares.size(); e++) {
            const double by_sizes = i == j ? 0 : 0.5 * alike * (shares[e](i, i) / is[i] + shares[e](j, j) / is[j]);
            errors.slope(k, Eigen::Index(e)) = counts * (by_sizes - shares[e](i, j) / size);
        }
    }
    return errors;
}

// The largest logarithm of the cage's compliance to forces and weight over the rods', small ones left out.
double worst_error(Bench& bench) {
    const std::vector<Compliance> shares = bench.measure();
    if (shares.empty()) return INFINITY;
    const Compliance cage = sum_of(shares);
    double worst = 0;
    for (int first : {TIP_FORCE, WEIGHT}) {
        const double least = FLOOR * bench.rods.diagonal().segment<3>(first).maxCoeff();
        for (int i = first; i < first + 3; i++)
            if (bench.rods(i, i) > least) worst = std::max(worst, std::abs(std::log(cage(i, i) / bench.rods(i, i))));
    }
    return worst;
}

// Half of what each tet's grain may still become stiffer beside the rest, as a logarithm.
VecX grain_room(const Bench& bench) {
    VecX room(Eigen::Index(bench.tet_count()));
    for (Eigen::Index e = 0; e < room.size(); e++)
        room[e] = 0.5 * std::log(MOST_GRAIN * bench.lone.model.tet_young[size_t(e)] /
                                 bench.lone.model.tet_grain[size_t(e)]);
    return room.cwiseMax(0);
}

bool fit_tets(Bench& bench) {
    constexpr double SOFTEST = 0.25, STIFFEST = 6;         // of a tet, over how it began [-]
    constexpr double LEAST_ALONG = 0.02, MOST_ALONG = 30;  // of its grain [-]
    constexpr double LARGEST_STEP = 1;                     // of a logarithm [-]
    constexpr double RIGID = 0.01;                         // what a change counts beside an error [-]
    constexpr double CLOSE = 2e-3;                         // an error that is none [-]
    constexpr int MOST_ROUNDS = 5, LAST_ROUNDS = 3;
    const Model before = bench.lone.model;
    const size_t tet_count = bench.tet_count();
    const Eigen::Index half = Eigen::Index(tet_count);
    VecX change = VecX::Zero(bench.plain ? half : 2 * half), least = change, most = change;
    least.setConstant(std::log(LEAST_ALONG)), most.setConstant(std::log(MOST_ALONG));
    least.head(half).setConstant(std::log(SOFTEST)), most.head(half).setConstant(std::log(STIFFEST));
    for (int round = 0; round < MOST_ROUNDS + LAST_ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        const bool last = round >= MOST_ROUNDS;
        const Errors errors = errors_of(shares, bench.rods, {bench.plain, last});
        if (last && errors.value.lpNorm<Eigen::Infinity>() < CLOSE) break;
        VecX lowest = (least - change).array().max(-LARGEST_STEP), highest = (most - change).array().min(LARGEST_STEP);
        if (!bench.plain) {
            const VecX room = grain_room(bench);
            lowest.head(half) = lowest.head(half).cwiseMax(-room);
            highest.tail(half) = highest.tail(half).cwiseMin(room);
        }
        const VecX step = least_change(errors.slope, -errors.value, lowest, highest, RIGID);
        for (size_t e = 0; e < tet_count; e++)
            bench.scale(e, std::exp(step[Eigen::Index(e)]), bench.plain ? 1 : std::exp(step[half + Eigen::Index(e)]));
        change += step;
    }
    // Where that is not to be had, as in blades one cell thick and many times as wide, tets are drawn apart in vain, and the
    // softest turn inside out when the plant is pulled.
    constexpr double MENDED = 0.2;  // of a logarithm [-]
    if (worst_error(bench) > MENDED)
        for (size_t e = 0; e < tet_count; e++)
            bench.scale(e, before.tet_young[e] / bench.lone.model.tet_young[e],
                        bench.plain ? 1 : before.tet_grain[e] / bench.lone.model.tet_grain[e]);
    return true;
}

}  // namespace

bool fit_moduli(LoneOrgan& lone, const Model& plant, const std::vector<int>& hangs, int order) {
    const LoadPlaces load_places = find_load_places(plant, lone.organ);
    if (load_places.tip < 0) return false;
    const std::vector<Compliance> rod_shares = rod_compliances(plant, lone.organ, load_places);
    const Compliance rods = sum_of(rod_shares);
    if (!(rods.diagonal().minCoeff() > 0)) return false;

    const double edge = mean_edge(lone.model.cage);
    const bool plain = !may_have_grain(plant, lone.organ);
    for (size_t e = 0; e < lone.tets.size(); e++)
        set_first_moduli(plant.sections[size_t(hangs[lone.tets[e]])], plant.organ_stiffer[size_t(lone.organ)], edge,
                         plant.cage.tet_fill[lone.tets[e]], plain, lone.model, e);
    Bench bench(lone, rods, order, plain);
    bench.loads = cage_loads(lone, bench.elements, plant, hangs, load_places);
    return fit_whole(bench) && fit_places(bench, find_places(lone, plant, hangs, rod_shares, rods)) && fit_tets(bench);
}

}  // namespace frond
