// In: an organ's cage, alone, and its rods. Out: moduli of the tets with which the cage has the rods' compliance.
//
// First the organ as a whole and slab by slab: under equal loads elastic energy is inversely proportional to modulus,
// so the factor is the ratio of energies, cage over rods. Then tet by tet, because a lattice of one cell across is not
// equally stiff in all directions and hard to twist: Gauss-Newton rounds, each with the least change of the moduli's
// logarithms after which all compliances match, within bounds, since tets that are much softer than those around them
// turn inside out.
#include "calibration/fit_moduli.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/compliance.hpp"
#include "calibration/least_change.hpp"
#include "core/elementary.hpp"

namespace frond {
namespace {

// An organ's cage in elements of one order, with its loads.
struct Bench {
    LoneOrgan& lone;
    const Compliance rods;
    TetElements elements;
    StaticStiffness stiffness;
    CageLoads loads;

    Bench(LoneOrgan& lone, const Compliance& rods, int order)
        : lone(lone),
          rods(rods),
          elements(make_tet_elements(lone.model, nullptr, order)),
          stiffness(elements.pattern) {}
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;
    void scale(size_t e, double factor) {
        lone.model.tet_young[e] *= factor;
        elements.mu[e] *= factor;
        elements.lambda[e] *= factor;
    }
    bool is_blade() const { return rods(TIP_FORCE, TIP_FORCE) > 10 * rods(TIP_FORCE + 1, TIP_FORCE + 1); }
    std::vector<Compliance> measure() { return cage_compliances(lone, elements, stiffness, loads); }
};

// Returns a modulus with which a cage that reaches one edge beyond the organ has about its bending stiffness, less
// where the organ fills little of the tet.
double first_modulus(const Section& section, double stiffer, double edge, double fill) {
    const double thickness = section.thickness + edge, width = section.width + edge;
    return stiffer * 12 * section.bending_thin() / (frond::pow(thickness, 3) * width) * frond::pow(fill, 0.25);
}

// ---- slab by slab ---------------------------------------------------------------------------------------------------

// Returns the first chain node of each chain node's slab. Slabs are about `length` long, since tets resolve no finer.
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

// Returns the energy of a share under a force at the tip and under weight, summed over the three axes, each relative to
// the rods' total.
double energy_of(const Compliance& share, const Compliance& rods) {
    const auto trace = [](const Compliance& C, int first) { return C.diagonal().segment<3>(first).sum(); };
    return trace(share, TIP_FORCE) / trace(rods, TIP_FORCE) + trace(share, WEIGHT) / trace(rods, WEIGHT);
}
constexpr double WHOLE_ENERGY = 2;  // energy_of() the rods: a share of one for either load [-]

// The slab of each tet, and the energy that the rods have there.
struct Places {
    std::vector<int> of_tet;
    std::vector<double> wanted;  // one per chain node [-]
};

Places find_places(const LoneOrgan& lone, const Model& plant, const std::vector<int>& hangs,
                   const std::vector<Compliance>& rod_shares, const Compliance& rods) {
    constexpr double STRETCH = 1.5;  // length of a slab over the mean edge [-]
    const std::vector<int> first = stretches(plant.chain, lone.organ, STRETCH * mean_edge(lone.model.cage));
    Places places;
    std::vector<char> has_tets(first.size(), 0);
    for (size_t e : lone.tets) {
        places.of_tet.push_back(first[size_t(hangs[e])]);
        has_tets[size_t(places.of_tet.back())] = 1;
    }
    // A rod's energy counts in the nearest slab towards the base that has tets.
    const int home = int(std::find(has_tets.begin(), has_tets.end(), 1) - has_tets.begin());
    places.wanted.assign(first.size(), 0.0);
    for (size_t i = 0; i < first.size(); i++) {
        int node = first[i];
        while (node >= 0 && !has_tets[size_t(node)]) node = plant.chain.nodes[size_t(node)].parent;
        places.wanted[size_t(node >= 0 ? node : home)] += energy_of(rod_shares[i], rods);
    }
    return places;
}

bool fit_places(Bench& bench, const Places& places) {
    constexpr int ROUNDS = 3;                      // energies give a first factor only
    constexpr double LARGEST_FACTOR = 1e6;         // on a modulus in a round [-]
    constexpr double SOFTEST = 0.5, STIFFEST = 8;  // modulus of a slab over its first one [-]
    constexpr double BLUR = 0.3;                   // share of the organ's energy that is added to each of its slabs [-]
    const size_t tet_count = places.of_tet.size();
    std::vector<double> local(tet_count, 1.0);
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        std::vector<double> cage(places.wanted.size(), 0.0);
        double sum = 0;
        for (size_t e = 0; e < tet_count; e++) {
            const double energy = energy_of(shares[e], bench.rods);
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
            bench.scale(e, whole * local[e] / before);
        }
    }
    return true;
}

// ---- tet by tet --------------------------------------------------------------------------------------------------

// Aims of the fit: at first all loads count; then twist and moments hardly do; if that leaves bending far off, as in
// cells as long as a stem is thick, stretch hardly counts either, which fibres bear.
enum class Aim { EVERYTHING, BENDING, BENDING_ONLY };

bool is_moment(int load) {
    return load >= TIP_MOMENT && load < TIP_MOMENT + 3;
}

bool is_along(int load) {
    return load % 3 == 2;
}

// Returns how much a load counts.
double weight_of(int load, Aim aim) {
    if (load == TIP_MOMENT + 2) return aim == Aim::EVERYTHING ? 0.5 : 1e-3;
    if (is_moment(load)) return aim == Aim::EVERYTHING ? 0.5 : 0.1;
    return is_along(load) && aim == Aim::BENDING_ONLY ? 0.1 : 1;
}

// A compliance much smaller than the largest of its kind counts as zero.
constexpr double FLOOR = 0.03;  // over the largest [-]

// Errors of a cage's compliance and their derivatives by the logarithms of the tets' moduli.
struct Errors {
    VecX value;
    MatX slope;
};

// Finds the errors: of a load with itself the logarithm of the ratio, cage over rods; of two loads the difference of
// their correlations.
Errors errors_of(const std::vector<Compliance>& shares, const Compliance& rods, Aim aim) {
    constexpr double LARGE = 0.5;  // error beyond which it counts less, because it may be impossible to remove [-]
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
        const double error =
            i == j ? frond::log(is[i] / wanted[i]) : alike - rods(i, j) / std::sqrt(wanted[i] * wanted[j]);
        const double counts = std::sqrt(weight_of(i, aim) * weight_of(j, aim) / (1 + error * error / (LARGE * LARGE)));
        errors.value[k] = counts * error;
        for (size_t e = 0; e < shares.size(); e++) {
            const double by_sizes = i == j ? 0 : 0.5 * alike * (shares[e](i, i) / is[i] + shares[e](j, j) / is[j]);
            errors.slope(k, Eigen::Index(e)) = counts * (by_sizes - shares[e](i, j) / size);
        }
    }
    return errors;
}

// Largest errors of the cage's compliance to forces and weight, as logarithms of the ratio to the rods', small ones
// left out: of all, and of those across.
struct WorstErrors {
    double all = INFINITY, across = INFINITY;
};
WorstErrors worst_errors(const std::vector<Compliance>& shares, const Compliance& rods) {
    if (shares.empty()) return {};
    const Compliance cage = sum_of(shares);
    WorstErrors worst = {0, 0};
    for (int first : {TIP_FORCE, WEIGHT}) {
        const double least = FLOOR * rods.diagonal().segment<3>(first).maxCoeff();
        for (int i = first; i < first + 3; i++) {
            if (rods(i, i) <= least) continue;
            const double error = std::abs(frond::log(cage(i, i) / rods(i, i)));
            worst.all = std::max(worst.all, error);
            if (!is_along(i)) worst.across = std::max(worst.across, error);
        }
    }
    return worst;
}

// Progress of a fit, and the best state on its way: rounds may overshoot where tets are at their bounds.
struct Progress {
    VecX change;  // change of the moduli's logarithms
    VecX best_change;
    double best_error = INFINITY;  // its worst error of all
};

void move_to(Bench& bench, Progress& progress, const VecX& change) {
    for (size_t e = 0; e < bench.lone.tets.size(); e++)
        bench.scale(e, frond::exp(change[Eigen::Index(e)] - progress.change[Eigen::Index(e)]));
    progress.change = change;
}

bool fit_rounds(Bench& bench, Aim aim, int rounds, Progress& progress) {
    constexpr double SOFTEST = 0.25, STIFFEST = 6;  // modulus of a tet over its first one [-]
    constexpr double LARGEST_STEP = 1;              // of a logarithm [-]
    constexpr double RIGID = 0.01;                  // weight of a change relative to an error [-]
    constexpr double CLOSE = 2e-3;                  // error that counts as none [-]
    const double softest = frond::log(SOFTEST), stiffest = frond::log(STIFFEST);
    for (int round = 0; round < rounds; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        const Errors errors = errors_of(shares, bench.rods, aim);
        if (aim != Aim::EVERYTHING && errors.value.lpNorm<Eigen::Infinity>() < CLOSE) break;
        const double worst = worst_errors(shares, bench.rods).all;
        if (worst < progress.best_error) {
            progress.best_error = worst;
            progress.best_change = progress.change;
        }
        const VecX step =
            least_change(errors.slope, -errors.value, (softest - progress.change.array()).max(-LARGEST_STEP),
                         (stiffest - progress.change.array()).min(LARGEST_STEP), RIGID);
        move_to(bench, progress, progress.change + step);
    }
    return true;
}

bool fit_tets(Bench& bench) {
    constexpr double BENDS = 0.05, MENDED = 0.2;  // errors of a logarithm [-]
    const VecX before = VecX::Zero(Eigen::Index(bench.lone.tets.size()));
    Progress progress = {before, before};
    if (!fit_rounds(bench, Aim::EVERYTHING, 5, progress) || !fit_rounds(bench, Aim::BENDING, 3, progress)) return false;
    WorstErrors worst = worst_errors(bench.measure(), bench.rods);
    if (worst.all > MENDED && progress.best_error < MENDED && !bench.is_blade()) {
        move_to(bench, progress, progress.best_change);
        worst = worst_errors(bench.measure(), bench.rods);
    }
    // If no fit is possible, as in blades one cell thick and many times as wide, the tets' moduli spread in vain, and
    // the softest tets turn inside out when the plant is pulled.
    if (worst.all > MENDED)
        move_to(bench, progress, before);
    else if (worst.across > BENDS && !bench.is_blade())
        return fit_rounds(bench, Aim::BENDING_ONLY, 3, progress);
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
    for (size_t e = 0; e < lone.tets.size(); e++)
        lone.model.tet_young[e] =
            first_modulus(plant.sections[size_t(hangs[lone.tets[e]])], plant.organ_stiffer[size_t(lone.organ)], edge,
                          plant.cage.tet_fill[lone.tets[e]]);
    Bench bench(lone, rods, order);
    bench.loads = cage_loads(lone, bench.elements, plant, hangs, load_places);
    return fit_places(bench, find_places(lone, plant, hangs, rod_shares, rods)) && fit_tets(bench);
}

}  // namespace frond
