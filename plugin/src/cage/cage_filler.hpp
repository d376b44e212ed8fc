// Filler: the account of what each tet holds while a cage is filled, organ by organ.
#pragma once

#include <algorithm>

#include "cage/cage_parts.hpp"

namespace frond {

// What a tet holds of one organ.
struct Held {
    int organ;
    double tissue = 0;    // [m^3]
    double wall = 0;      // area of the organ's closed patches [m^2]
    double strength = 0;  // Young's modulus times the tissue at its surface [J]
};

struct Filler {
    const std::vector<Organ>& organs;
    Draft& draft;
    std::vector<double> volume;           // volume of each tet [m^3]
    std::vector<double> tissue;           // plant in each tet [m^3]
    std::vector<std::vector<Held>> held;  // the same, organ by organ
    std::vector<double> left;             // tissue of each organ that is not placed yet [m^3]

    // Returns what a tet holds of an organ, listed from now on.
    Held& of(size_t tet, int organ) {
        for (Held& known : held[tet])
            if (known.organ == organ) return known;
        held[tet].push_back({organ});
        return held[tet].back();
    }
    double wall_of(size_t tet, int organ) const {
        for (const Held& known : held[tet])
            if (known.organ == organ) return known.wall;
        return 0;
    }
    void add(size_t tet, int organ, double amount) {
        of(tet, organ).tissue += amount;
        tissue[tet] += amount;
    }
    double room(size_t tet) const { return std::max(0.0, volume[tet] - tissue[tet]); }
    int main_organ(size_t tet) const {
        return draft.patches.patches[size_t(draft.copies.patch[tet / TETS_PER_COPY])].organ;
    }
};

// Places what is left of each organ where tets have free volume, first where the organ is already, then anywhere.
void place_leftovers(Filler& filler);
// Gives nearly empty tets a least fill, taken from their own copy, or from their own organ elsewhere.
void level_tissue(Filler& filler);

}  // namespace frond
