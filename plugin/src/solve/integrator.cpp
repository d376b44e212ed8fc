// The table of integrators: one row for each name in FROND_INTEGRATORS.
#include "solve/integrator.hpp"

namespace frond {

const Integrator& integrator(frond_integrator which) {
    static const Integrator TABLE[] = {
        {"implicit_euler", step_implicit_euler, false, false, false, false},
        {"bdf2", step_bdf2, true, false, false, false},
        {"sdirk2", step_sdirk2, false, false, false, true},
        {"tr_bdf2", step_tr_bdf2, false, true, false, true},
        {"generalized_alpha", step_generalized_alpha, true, false, false, true},
        {"symplectic_euler", step_symplectic_euler, false, true, true, false},
    };
    static_assert(sizeof TABLE / sizeof TABLE[0] == FROND_INTEGRATOR_COUNT, "every integrator needs its row");
    return TABLE[which];
}

}  // namespace frond
