// Sections: the capsules of the chain, each named by the chain node at its end, as places where a plant may break.
#pragma once

#include "mechanics/mechanics.hpp"

namespace frond {

// The capsule that each tet of the cage belongs to: the nearest one of its organ, else of all; 0 if there is none.
std::vector<int> capsules_of_tets(const Model& model);

// Sets `breaking` of elements that are complete otherwise: the strain at which a material of that strength breaks, by
// strength over modulus, but no section breaks with less than 1.5 times the strain that it stands with.
void let_break(const Model& model, const Mechanics& row, Elements& elements);

// Takes entries away whose index is gone; a list that is empty stays so.
template <class List, class IsGone>
void keep_others(List& list, const IsGone& is_gone) {
    size_t kept = 0;
    for (size_t i = 0; i < list.size(); ++i)
        if (!is_gone(i)) list[kept++] = list[i];
    list.erase(list.begin() + std::ptrdiff_t(kept), list.end());
}

// The section that is strained most over what it breaks at, if that is more than it can bear; else -1.
int find_overload(const Mechanics& row, const Elements& elements, const VecX& x);

}  // namespace frond
