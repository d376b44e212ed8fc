// Results, names of choices, the log.
#include <cstring>

#include "api/call.hpp"
#include "core/log.hpp"

namespace frond {

// A fixed buffer: remembering a failure must not fail.
static thread_local char last_error[2048] = "";

frond_result report_failure(frond_result code, const char* text) noexcept {
    std::strncpy(last_error, text, sizeof last_error - 1);
    return code;
}

template <size_t COUNT>
static const char* row_name(const char* const (&names)[COUNT], int row, const char* otherwise) {
    return row >= 0 && row < int(COUNT) ? names[row] : otherwise;
}

}  // namespace frond

using namespace frond;

#define ROW_TEXT(code, text) text,
static const char* const RESULT_TEXTS[] = {FROND_RESULTS(ROW_TEXT)};
static const char* const MECHANICS_NAMES[] = {FROND_MECHANICS(ROW_TEXT)};
static const char* const INTEGRATOR_NAMES[] = {FROND_INTEGRATORS(ROW_TEXT)};
static const char* const LINEAR_SOLVER_NAMES[] = {FROND_LINEAR_SOLVERS(ROW_TEXT)};
static const char* const MASS_NAMES[] = {FROND_MASSES(ROW_TEXT)};
static const char* const COLLISION_NAMES[] = {FROND_COLLISIONS(ROW_TEXT)};
static const char* const HASH_LAYOUT_NAMES[] = {FROND_HASH_LAYOUTS(ROW_TEXT)};
static const char* const RESPONSE_NAMES[] = {FROND_RESPONSES(ROW_TEXT)};
static const char* const SHAPE_NAMES[] = {FROND_SHAPES(ROW_TEXT)};
static const char* const EVENT_NAMES[] = {FROND_EVENTS(ROW_TEXT)};
static const char* const DETAIL_NAMES[] = {FROND_DETAILS(ROW_TEXT)};
#undef ROW_TEXT
#define EFFECT_TEXT(code, bit, text) text,
static const char* const EFFECT_NAMES[] = {FROND_EFFECTS(EFFECT_TEXT)};
#undef EFFECT_TEXT

extern "C" {

const char* frond_version_string(void) {
    return FROND_VERSION_STRING;
}
const char* frond_result_name(frond_result result) {
    return row_name(RESULT_TEXTS, number_of(result), "unknown result");
}
const char* frond_last_error(void) {
    return last_error;
}
void frond_set_log(frond_log_fn* log, void* user) {
    set_log(log, user);
}

const char* frond_mechanics_name(frond_mechanics mechanics) {
    return row_name(MECHANICS_NAMES, number_of(mechanics), "?");
}
const char* frond_integrator_name(frond_integrator integrator) {
    return row_name(INTEGRATOR_NAMES, number_of(integrator), "?");
}
const char* frond_linear_solver_name(frond_linear_solver solver) {
    return row_name(LINEAR_SOLVER_NAMES, number_of(solver), "?");
}
const char* frond_shape_name(frond_shape shape) {
    return row_name(SHAPE_NAMES, number_of(shape), "?");
}
const char* frond_mass_name(frond_mass mass) {
    return row_name(MASS_NAMES, number_of(mass), "?");
}
const char* frond_collision_name(frond_collision collision) {
    return row_name(COLLISION_NAMES, number_of(collision), "?");
}
const char* frond_hash_layout_name(frond_hash_layout layout) {
    return row_name(HASH_LAYOUT_NAMES, number_of(layout), "?");
}
const char* frond_response_name(frond_response response) {
    return row_name(RESPONSE_NAMES, number_of(response), "?");
}
const char* frond_event_name(frond_event event) {
    return row_name(EVENT_NAMES, number_of(event), "?");
}
const char* frond_detail_name(frond_detail detail) {
    return row_name(DETAIL_NAMES, number_of(detail), "?");
}
const char* frond_effect_name(frond_effects effect) {
    for (int bit = 0; bit < FROND_EFFECT_COUNT; bit++)
        if (effect == 1u << bit) return EFFECT_NAMES[bit];
    return "?";
}

}  // extern "C"
