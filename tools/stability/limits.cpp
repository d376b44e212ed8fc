// What a method cannot pass, with the reason in a line.
#include <cstring>

#include "stability/stability.hpp"

namespace frond::stability {

namespace {

struct Limit {
    frond_mechanics mechanics;
    const char* name;  // of a case
    const char* why;
};

constexpr Limit LIMITS[] = {
    {FROND_TET_LINEAR, "stiffness_ratio",
     "soft tets that share cells with stiff ones turn far, and what turns far grows"},
    {FROND_TET_LINEAR, "dropped",
     "a plant that turns as a whole is strained by turning: linear mechanics know no rotation"},
    {FROND_TET_LINEAR, "above_buckling",
     "what is strained along bends no more easily for that: linear mechanics know no buckling"},
    {FROND_TET_LINEAR, "broken_in_contact", "what a ball turns over is strained by turning"},
};

}  // namespace

const char* known_limit(const std::string& name, frond_mechanics mechanics) {
    for (const Limit& limit : LIMITS)
        if (limit.mechanics == mechanics && name == limit.name) return limit.why;
    return nullptr;
}

}  // namespace frond::stability
