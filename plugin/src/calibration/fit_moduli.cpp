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
    bool blade = false;

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
    // Scales the fibres' modulus alone.
    void scale_grain(size_t e, double factor) {
        lone.model.tet_grain[e] *= factor;
        elements.grain[e] *= factor;
    }
    // Scales one part, counted as measure() does.
    void scale_part(size_t part, double factor) {
        const size_t count = lone.tets.size();
        if (part >= count) return scale_grain(part - count, factor);
        scale(part, factor);
        scale_grain(part, 1 / factor);
    }
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

// Divides the moduli between tissue and fibres until twist is right as well as bending: fibres do not resist twist.
bool fit_parts(Bench& bench) {
    constexpr int ROUNDS = 10;
    constexpr double LARGEST_STEP = 1.5, LEAST_GRAIN = 0.01;
    double MOST_GRAIN = getenv("MOST") ? atof(getenv("MOST")) : 100;
    if (bench.rods(TIP_FORCE, TIP_FORCE) > 10 * bench.rods(TIP_FORCE + 1, TIP_FORCE + 1) || bench.blade) MOST_GRAIN = getenv("BL") ? atof(getenv("BL")) : 0.01;
    const size_t count = bench.lone.tets.size();
    double grain = std::min(10.0, MOST_GRAIN);
    for (size_t e = 0; e < count; e++) bench.lone.model.tet_grain[e] = bench.elements.grain[e] = grain;
    for (int round = 0; round < ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        Compliance tissue = Compliance::Zero(), fibres = tissue;
        for (size_t e = 0; e < count; e++) tissue += shares[e], fibres += shares[count + e];
        const auto twist = [&](const Compliance& c) { return c(TIP_MOMENT + 2, TIP_MOMENT + 2); };
        const auto bend = [&](const Compliance& c) { return energy_of(c, bench.rods); };
        const double twisted = twist(tissue) + twist(fibres), bent = bend(tissue) + bend(fibres);
        Eigen::Matrix2d slope;
        slope << twist(tissue) / twisted, twist(fibres) / twisted, bend(tissue) / bent, bend(fibres) / bent;
        const Eigen::Vector2d error(frond::log(twisted / twist(bench.rods)), frond::log(bent / WHOLE_ENERGY));
        const Eigen::Matrix2d square = slope.transpose() * slope + 1e-3 * Eigen::Matrix2d::Identity();
        const Eigen::Vector2d step =
            (square.inverse() * slope.transpose() * error).cwiseMax(-LARGEST_STEP).cwiseMin(LARGEST_STEP);
        const double next = std::clamp(grain * frond::exp(step[1] - step[0]), LEAST_GRAIN, MOST_GRAIN);
        for (size_t e = 0; e < count; e++) {
            bench.scale(e, frond::exp(step[0]));
            bench.scale_grain(e, next / grain);
        }
        grain = next;
    }
    if (getenv("FIT")) {
        const std::vector<Compliance> shares = bench.measure();
        Compliance tissue = Compliance::Zero(), fibres = tissue;
        for (size_t e = 0; e < count; e++) tissue += shares[e], fibres += shares[count + e];
        fprintf(stderr, "grain %g; of fibres", grain);
        for (int i = 0; i < LOAD_COUNT; i++) fprintf(stderr, "%s%.2f", i % 3 ? " " : " | ", fibres(i, i) / (tissue(i,i)+fibres(i,i)));
        for (int i = 0; i < LOAD_COUNT; i++) fprintf(stderr, "%s%.3g", i % 3 ? " " : " | ", (tissue(i,i)+fibres(i,i))/ bench.rods(i, i));
        fprintf(stderr, "\n");
    }
    return true;
}

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
            const double energy = energy_of(shares[e] + shares[tet_count + e], bench.rods);
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

bool is_moment(int load) {
    return load >= TIP_MOMENT && load < TIP_MOMENT + 3;
}

// Returns how much a load counts.
double weight_of(int load) {
    static const double TW = getenv("TW") ? atof(getenv("TW")) : 0.5, MO = getenv("MO") ? atof(getenv("MO")) : 0.5;
    return load == TIP_MOMENT + 2 ? TW : is_moment(load) ? MO : 1;
}

// Share of the largest compliance of a kind that is added to all of them, as what a load hardly moves hardly counts.
static const double FLOOR = getenv("FLOOR") ? atof(getenv("FLOOR")) : 1;  // [-]

// Errors of a cage's compliance and their derivatives by the logarithms of the tets' moduli.
struct Errors {
    VecX value;
    MatX slope;
};

// Finds the errors: of a load with itself the logarithm of the ratio, cage over rods; of two loads the difference of
// their correlations.
Errors errors_of(const std::vector<Compliance>& shares, const Compliance& rods) {
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
        const double counts = std::sqrt(weight_of(i) * weight_of(j) / (1 + error * error / (LARGE * LARGE)));
        errors.value[k] = counts * error;
        for (size_t e = 0; e < shares.size(); e++) {
            const double by_sizes = i == j ? 0 : 0.5 * alike * (shares[e](i, i) / is[i] + shares[e](j, j) / is[j]);
            errors.slope(k, Eigen::Index(e)) = counts * (by_sizes - shares[e](i, j) / size);
        }
    }
    return errors;
}

// Progress of a fit, and the best state on its way: rounds may overshoot where tets are at their bounds.
struct Progress {
    VecX change;  // change of the logarithms of the parts' moduli
    VecX best_change;
    double least_error = INFINITY;  // sum of the squares of its errors
};

void move_to(Bench& bench, Progress& progress, const VecX& change) {
    for (Eigen::Index part = 0; part < change.size(); part++)
        bench.scale_part(size_t(part), frond::exp(change[part] - progress.change[part]));
    progress.change = change;
}

bool fit_tets(Bench& bench) {
    static const int ROUNDS = getenv("ROUNDS") ? atoi(getenv("ROUNDS")) : 10;
    static const double SOFTEST = getenv("LO") ? atof(getenv("LO")) : 0.25, STIFFEST = getenv("HI") ? atof(getenv("HI")) : 6;  // modulus over the first one [-]
    constexpr double LARGEST_STEP = 1;              // of a logarithm [-]
    constexpr double RIGID = 0.01;                  // weight of a change relative to an error [-]
    const double softest = frond::log(SOFTEST), stiffest = frond::log(STIFFEST);
    const VecX before = VecX::Zero(2 * Eigen::Index(bench.lone.tets.size()));
    Progress progress = {before, before};
    for (int round = 0; round <= ROUNDS; round++) {
        const std::vector<Compliance> shares = bench.measure();
        if (shares.empty()) return false;
        const Errors errors = errors_of(shares, bench.rods);
        const double error = errors.value.squaredNorm();
        if (error < progress.least_error) {
            progress.least_error = error;
            progress.best_change = progress.change;
        }
        if (round == ROUNDS) break;
        const VecX step =
            least_change(errors.slope, -errors.value, (softest - progress.change.array()).max(-LARGEST_STEP),
                         (stiffest - progress.change.array()).min(LARGEST_STEP), RIGID);
        move_to(bench, progress, progress.change + step);
    }
    move_to(bench, progress, progress.best_change);
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
    bench.blade = plant.organs[size_t(lone.organ)].kind == "blade";
    bench.loads = cage_loads(lone, bench.elements, plant, hangs, load_places);
    const bool ok = fit_parts(bench) && fit_places(bench, find_places(lone, plant, hangs, rod_shares, rods)) && fit_tets(bench);
    if (getenv("FIT")) {
        const Compliance cage = sum_of(bench.measure());
        fprintf(stderr, "%-14s o%d tets %4zu  ", plant.organs[size_t(lone.organ)].name.c_str(), order, lone.tets.size());
        for (int i = 0; i < LOAD_COUNT; i++) fprintf(stderr, "%s%.3g", i % 3 ? " " : " | ", cage(i, i) / rods(i, i));
        fprintf(stderr, "   rods tip %.2g %.2g %.2g\n", rods(0, 0), rods(1, 1), rods(2, 2));
    }
    return ok;
}

}  // namespace frond
