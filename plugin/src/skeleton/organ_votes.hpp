// Votes on what each organ is, by its shape, place, name, material, colour and texture.
#pragma once

#include "skeleton/organ.hpp"

namespace frond {

// An organ that was found: its kind, what speaks for it, and how sure that is.
struct FoundOrgan {
    std::string kind, why;
    double certainty = 1;  // 0: another kind is as likely, 1: nothing speaks for another one [-]
};

struct FoundOrgans {
    std::vector<FoundOrgan> organs;
    std::vector<int> organ_of;  // by triangle
};

// Finds the organs of a plant. `named` are the kinds that the parts' names mean, empty where they say nothing; `crowns`
// says which triangles belong to round solids.
FoundOrgans vote_on_organs(const Surface& surface, const Topology& topology, std::vector<std::string> named,
                           const std::vector<char>& crowns);

}  // namespace frond
