#include "world/contact.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "plant/touch.hpp"
#include "world/plant_contact.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

bool Shortfall::ask_for(double now) {
    constexpr double HELPS = 0.98, LEAST = 0.05;  // over what was left; share of what was asked that is done [-]
    const bool helps = may_ask && now < HELPS * left;
    const double done = asked > 0 ? std::clamp((left - now) / asked, LEAST, 1.0) : 1;
    left = now;
    asked = helps ? now / done : 0;
    lacking += asked;
    return helps;
}

Attachment attachment_of(const Contact& contact) {
    FROND_ASSERT(contact.capsule >= 0 && size_t(contact.capsule) < contact.plant->hull->flats.size());
    const Flat& flat = contact.plant->hull->flats[size_t(contact.capsule)];
    return flat_attachment(*contact.plant->plant, contact.capsule, flat, contact.along, contact.across);
}

bool is_by_the_same(const PlantContact& contact) {
    for (size_t k = 0; k < 2; k++) {
        const Plant& plant = *contact.plants[k]->plant;
        if (contact.on_chain[k] != (plant.follow != nullptr) || contact.by_sheath[k] != touches_by_sheath(plant))
            return false;
    }
    return true;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
