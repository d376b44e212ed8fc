// Sections: the capsules of the chain, each identified by the chain node at its end, as places where a plant may break.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// Returns the capsule of each tet of the cage: the nearest one of its organ, else of all; 0 if there is none.
std::vector<int> capsules_of_tets(const Model& model);

// Sets `breaking` of elements that are otherwise complete: the material's strength over its modulus, but at least 1.5
// times the strain in which the plant stands.
void let_break(const Model& model, const Mechanics& row, Elements& elements);

// Removes the entries whose index is gone; an empty list stays empty.
template <class List, class IsGone>
void keep_others(List& list, const IsGone& is_gone) {
    size_t kept = 0;
    for (size_t i = 0; i < list.size(); ++i)
        if (!is_gone(i)) list[kept++] = list[i];
    list.erase(list.begin() + std::ptrdiff_t(kept), list.end());
}

// Returns the section with the highest strain over its breaking strain, if that is above one; else -1.
int find_overload(const Mechanics& row, const Elements& elements, const VecX& x);

}  // namespace frond
