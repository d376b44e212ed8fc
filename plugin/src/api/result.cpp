// Results, names of choices, the log.
#include <cstring>

#include "api/call.hpp"
#include "core/log.hpp"
#include "frond/frond_robot.h"

namespace frond {

// A fixed buffer: remembering a failure must not fail.
static thread_local char last_error[2048] = "";

frond_result report_failure(frond_result code, const char* text) noexcept {
    std::strncpy(last_error, text, sizeof last_error - 1);
    return code;
}

}  // namespace frond

using namespace frond;

template <size_t COUNT>
static const char* row_name(const char* const (&names)[COUNT], int row, const char* otherwise = "?") {
    return row >= 0 && row < int(COUNT) ? names[row] : otherwise;
}

#define FROND_ROW_TEXT(code, text) text,

extern "C" {

const char* frond_version_string(void) {
    return FROND_VERSION_STRING;
}
const char* frond_result_name(frond_result result) {
    static const char* const TEXTS[] = {FROND_RESULTS(FROND_ROW_TEXT)};
    return row_name(TEXTS, number_of(result), "unknown result");
}
const char* frond_last_error(void) {
    return last_error;
}
void frond_set_log(frond_log_fn* log, void* user) {
    set_log(log, user);
}

// Defines a function that returns the short name of a choice, from the list of its rows.
#define FROND_NAME_FUNCTION(function, choice, ROWS)                \
    const char* function(choice row) {                             \
        static const char* const NAMES[] = {ROWS(FROND_ROW_TEXT)}; \
        return row_name(NAMES, number_of(row));                    \
    }
FROND_NAME_FUNCTION(frond_mechanics_name, frond_mechanics, FROND_MECHANICS)
FROND_NAME_FUNCTION(frond_integrator_name, frond_integrator, FROND_INTEGRATORS)
FROND_NAME_FUNCTION(frond_linear_solver_name, frond_linear_solver, FROND_LINEAR_SOLVERS)
FROND_NAME_FUNCTION(frond_shape_name, frond_shape, FROND_SHAPES)
FROND_NAME_FUNCTION(frond_mass_name, frond_mass, FROND_MASSES)
FROND_NAME_FUNCTION(frond_collision_name, frond_collision, FROND_COLLISIONS)
FROND_NAME_FUNCTION(frond_hash_layout_name, frond_hash_layout, FROND_HASH_LAYOUTS)
FROND_NAME_FUNCTION(frond_response_name, frond_response, FROND_RESPONSES)
FROND_NAME_FUNCTION(frond_event_name, frond_event, FROND_EVENTS)
FROND_NAME_FUNCTION(frond_detail_name, frond_detail, FROND_DETAILS)
FROND_NAME_FUNCTION(frond_joint_name, frond_joint, FROND_JOINTS)

const char* frond_effect_name(frond_effects effect) {
#define FROND_EFFECT_TEXT(code, bit, text) \
    if (effect == FROND_EFFECT_##code) return text;
    FROND_EFFECTS(FROND_EFFECT_TEXT)
    return "?";
}

}  // extern "C"
