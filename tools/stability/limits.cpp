// The cases that a method cannot pass, each with a reason in one line.
#include "stability/stability.hpp"

namespace frond::stability {

namespace {

constexpr int ANY = -1;

struct Limit {
    const char* name;  // name of a case
    int mechanics, integrator;
    const char* why;
};

constexpr Limit LIMITS[] = {
    {"stiffness_ratio", FROND_MECHANICS_TET_LINEAR, ANY,
     "soft tets that share cells with stiff ones turn far, and what turns far grows"},
    {"soft", FROND_MECHANICS_SPRING_CHAIN, ANY,
     "what its weight crushes falls into its own segments at full speed, on its course, and is not asked for its "
     "energy"},
    {"soft", FROND_MECHANICS_ROD, ANY,
     "what its weight crushes falls into its own segments at full speed, on its course, and is not asked for its "
     "energy"},
    {"gravity_1e5_g", FROND_MECHANICS_TET_LINEAR, ANY,
     "what resists in proportion gives way in proportion: 1e5 times as far as by its weight"},
    {"dropped", FROND_MECHANICS_TET_LINEAR, ANY,
     "a plant that turns as a whole is strained by turning: linear mechanics know no rotation"},
    {"above_buckling", FROND_MECHANICS_TET_LINEAR, ANY,
     "what is strained along bends no more easily for that: linear mechanics know no buckling"},
    {"ball_1e4", FROND_MECHANICS_TET_LINEAR, ANY,
     "what a heavy ball turns over is strained by turning, and flies back faster"},
    {"broken_in_contact", FROND_MECHANICS_TET_LINEAR, ANY, "what a ball turns over is strained by turning"},
    {"needles", ANY, FROND_INTEGRATOR_IMPLICIT_EULER,
     "one solve with what bends where the step begins: what whips is drawn out by some per cent of its energy"},
    {"needles", ANY, FROND_INTEGRATOR_TR_BDF2,
     "it counts forces where the step begins for half: what whips is drawn out by some per cent of its energy"},
    {"poisson_0.499", ANY, FROND_INTEGRATOR_IMPLICIT_EULER,
     "one solve with what turns where the step begins: some per cent of its energy go into volume, which is stiff; two "
     "solves a step hold"},
    {"poisson_0.499", ANY, FROND_INTEGRATOR_TR_BDF2,
     "it counts forces where the step begins for half: some per cent of its energy go into volume, which is stiff; two "
     "solves a step hold"},
    {"loose_solver", FROND_MECHANICS_TET_LINEAR, FROND_INTEGRATOR_IMPLICIT_EULER,
     "it forgets with each step what the last one was heading for: rough solves lag behind by some per cent more"},
    {"loose_solver", ANY, FROND_INTEGRATOR_GENERALIZED_ALPHA,
     "it has to be iterated to convergence, which rough solves do not come to"},
    {"corn_dragged", FROND_MECHANICS_TET_COROTATIONAL, ANY,
     "a leaf that is folded over stays so until its plant rests: its cage is too soft to turn it back"},
    {"corn_flung", FROND_MECHANICS_TET_COROTATIONAL, ANY,
     "a plant that touches takes one solve of implicit Euler, and in steps of 1/30 s a limp leaf goes on swaying; "
     "solved to convergence it rests after 3 s"},
};

}  // namespace

const char* known_limit(const Result& result) {
    if (!result.verdict.is_missed) return nullptr;
    const Cell& cell = result.cell;
    for (const Limit& limit : LIMITS)
        if (std::string(limit.name) == result.of->name &&
            (limit.mechanics == ANY || limit.mechanics == cell.mechanics) &&
            (limit.integrator == ANY || limit.integrator == cell.integrator))
            return limit.why;
    return nullptr;
}

bool is_unexplained(const Result& result) {
    return result.verdict.color == Color::RED && !known_limit(result);
}

}  // namespace frond::stability
