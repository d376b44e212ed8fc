#include "api/handles.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void show(PlantBody& body) {
    move_capsules(body);
    body.world->bullet->updateSingleAabb(&body);
}

Plant& awaken(PlantBody& body) {
    wake(body);
    end_sway(body);
    disturb(body);
    return *body.plant;
}

void forget(PlantBody& body) {
    for (const Bond& bond : body.world->bonds)
        if (bond.plant == &body) slots<frond_bond>().erase(bond.handle);
    for (const Grab& grab : body.plant->input.grabs) slots<frond_grab>().erase(grab.handle);
    for (const Rigid* fragment : body.fragment_bodies) slots<frond_rigid>().erase(fragment->handle.id);
    slots<frond_plant>().erase(body.handle.id);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
