// In: an account of tissue that may exceed tets' volumes or leave tets empty. Out: one that fits and leaves none empty,
// in which every organ has the same tissue as before, about where it was.
#include <algorithm>

#include "cage/cage_filler.hpp"

namespace frond {

namespace {

// Least fill of a tet, as a share of the mean fill of its copy, and of that as a share of the mean fill of its organ's
// copies, so that no node is without mass.
constexpr double LEAST_SHARE = 0.1;

// The tets that hold an organ, with its tissue there.
using Tets = std::vector<std::pair<size_t, double>>;

std::vector<Tets> list_tets(const Filler& filler) {
    std::vector<Tets> tets(filler.organs.size());
    for (size_t tet = 0; tet < filler.held.size(); ++tet)
        for (const Held& held : filler.held[tet]) tets[size_t(held.organ)].push_back({tet, held.tissue});
    return tets;
}

// Places tissue of an organ in tets as far as they have free volume, in proportion to their weights. Returns the rest.
double place(Filler& filler, int organ, const Tets& tets, double amount) {
    double sum = 0, rest = 0;
    for (const auto& [tet, weight] : tets)
        if (filler.room(tet) > 0) sum += weight;
    if (!(sum > 0)) return amount;
    for (const auto& [tet, weight] : tets) {
        const double room = filler.room(tet);
        if (!(room > 0)) continue;
        const double taken = std::min(room, amount * weight / sum);
        rest += amount * weight / sum - taken;
        filler.add(tet, organ, taken);
    }
    return rest;
}

void weigh_by_room(const Filler& filler, Tets& tets) {
    for (auto& [tet, weight] : tets) weight = filler.room(tet);
}

// Scales the tissue of each organ wherever it is.
void scale_tissue(Filler& filler, const std::vector<double>& factors) {
    for (size_t tet = 0; tet < filler.held.size(); ++tet)
        for (Held& held : filler.held[tet]) {
            const double less = (1 - factors[size_t(held.organ)]) * held.tissue;
            filler.tissue[tet] -= less;
            held.tissue -= less;
        }
}

// Takes what does not fit out of tets.
void take_excess(Filler& filler) {
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) {
        if (filler.tissue[tet] <= filler.volume[tet]) continue;
        const double share = filler.volume[tet] / filler.tissue[tet];
        for (Held& held : filler.held[tet]) {
            filler.left[size_t(held.organ)] += (1 - share) * held.tissue;
            held.tissue *= share;
        }
        filler.tissue[tet] = filler.volume[tet];
    }
}

std::vector<double> tissue_of_organs(const Filler& filler) {
    std::vector<double> tissue(filler.organs.size(), 0.0);
    for (const std::vector<Held>& list : filler.held)
        for (const Held& held : list) tissue[size_t(held.organ)] += held.tissue;
    return tissue;
}

// A negative rest, from rounding or from a patch that intersects itself, reduces the tissue already there.
void take_debts(Filler& filler) {
    constexpr double LEAST_LEFT = 0.1;  // share of the tissue that is kept in any case
    const std::vector<double> tissue = tissue_of_organs(filler);
    std::vector<double> factors(tissue.size(), 1.0);
    for (size_t o = 0; o < factors.size(); ++o)
        if (filler.left[o] < 0 && tissue[o] > 0) factors[o] = std::max(LEAST_LEFT, 1 + filler.left[o] / tissue[o]);
    scale_tissue(filler, factors);
}

// Returns the mean fill of the copies that mostly carry each organ, with that organ's tissue alone.
std::vector<double> mean_fills(const Filler& filler) {
    std::vector<double> fills = tissue_of_organs(filler), volume(fills.size(), 0.0);
    for (size_t tet = 0; tet < filler.volume.size(); ++tet)
        volume[size_t(filler.main_organ(tet))] += filler.volume[tet];
    for (size_t o = 0; o < fills.size(); ++o)
        if (volume[o] > 0) fills[o] /= volume[o];
    return fills;
}

// Gives copies that hold next to nothing a little of the organ that they mostly carry, from wherever it is.
void fill_empty_copies(Filler& filler) {
    const std::vector<double> fills = mean_fills(filler), whole = tissue_of_organs(filler);
    std::vector<double> added(filler.tissue.size(), 0.0), factors(fills.size(), 1.0);
    for (size_t first = 0; first < filler.tissue.size(); first += TETS_PER_COPY) {
        const size_t organ = size_t(filler.main_organ(first));
        double lacking = 0;
        for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet)
            lacking += LEAST_SHARE * LEAST_SHARE * fills[organ] * filler.volume[tet] - filler.tissue[tet];
        if (lacking <= 0) continue;
        double volume = 0;
        for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) volume += filler.volume[tet];
        for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) added[tet] = lacking * filler.volume[tet] / volume;
        factors[organ] -= lacking / whole[organ];
    }
    scale_tissue(filler, factors);
    for (size_t tet = 0; tet < added.size(); ++tet)
        if (added[tet] > 0) filler.add(tet, filler.main_organ(tet), added[tet]);
}

// Moves tissue of each organ within a copy from its fuller tets to those below the least fill. `moved`: scratch.
void level_copy(Filler& filler, size_t first, std::vector<Held>& moved) {
    double tissue = 0, volume = 0;
    for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) {
        tissue += filler.tissue[tet];
        volume += filler.volume[tet];
    }
    const double least = LEAST_SHARE * tissue / volume;
    double lacking = 0, above = 0;
    for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) {
        const double over = filler.tissue[tet] - least * filler.volume[tet];
        (over < 0 ? lacking : above) += std::abs(over);
    }
    if (lacking == 0) return;
    moved.clear();
    for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) {
        const double over = filler.tissue[tet] - least * filler.volume[tet];
        if (over <= 0) continue;
        const double share = lacking / above * over / filler.tissue[tet];
        for (Held& held : filler.held[tet]) {
            const auto same =
                std::find_if(moved.begin(), moved.end(), [&](const Held& other) { return other.organ == held.organ; });
            if (same == moved.end())
                moved.push_back({held.organ, share * held.tissue});
            else
                same->tissue += share * held.tissue;
            held.tissue *= 1 - share;
        }
        filler.tissue[tet] *= 1 - share;
    }
    for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) {
        const double over = filler.tissue[tet] - least * filler.volume[tet];
        if (over >= 0) continue;
        for (const Held& part : moved) filler.add(tet, part.organ, part.tissue * -over / lacking);
    }
}

}  // namespace

void place_leftovers(Filler& filler) {
    constexpr int ROUNDS = 4;  // tets that become full leave a rest to the others
    take_excess(filler);
    take_debts(filler);
    std::vector<Tets> tets = list_tets(filler);
    Tets all;
    for (size_t o = 0; o < tets.size(); ++o) {
        double rest = filler.left[o];
        for (int round = 0; round < ROUNDS && rest > 0; ++round) rest = place(filler, int(o), tets[o], rest);
        if (!(rest > 0)) continue;
        weigh_by_room(filler, tets[o]);
        rest = place(filler, int(o), tets[o], rest);
        if (!(rest > 0)) continue;
        if (all.empty())
            for (size_t tet = 0; tet < filler.tissue.size(); ++tet) all.push_back({tet, 0});
        weigh_by_room(filler, all);
        place(filler, int(o), all, rest);
    }
}

void level_tissue(Filler& filler) {
    fill_empty_copies(filler);
    std::vector<Held> moved;
    for (size_t first = 0; first < filler.tissue.size(); first += TETS_PER_COPY) level_copy(filler, first, moved);
}

}  // namespace frond
