// The table of integrators: one row for each name in FROND_INTEGRATORS.
#include "solve/integrator.hpp"

namespace frond {

const Integrator& integrator(frond_integrator which) {
    static const Integrator TABLE[] = {
        {"implicit_euler", step_implicit_euler},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_INTEGRATOR_COUNT, "every integrator needs its row");
    return TABLE[which];
}

}  // namespace frond
