// In: contacts of a substep. Out: events of those that did not exist in the substep before.
//
// A contact exists from when it pushes or overlaps until the search no longer finds it, so that a body that rests on a
// plant does not begin to touch it again and again.
#include "world/events.hpp"

#include <algorithm>

#include "core/lists.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

void add_event(World& world, frond_event event, const PlantBody& body, int capsule) {
    constexpr size_t MOST = 65536;                          // events that are kept, as the header says: 3 MB
    if (!world.events.are_kept || !body.handle.id) return;  // not requested, or the host has no handle of the plant
    std::deque<frond_event_info>& list = world.events.list;
    if (list.size() == MOST) list.pop_front();
    const double time = world.time + (world.is_stepping ? world.substep_length : 0);
    list.push_back({event, time, body.handle, capsule, nullptr, {}});
}

namespace {

struct TouchedPair {
    Events::Touching who;
    int capsule;
    bool pushes;
};

// Lists both sides of contacts of two plants, and one side of contacts of a plant with itself.
std::vector<TouchedPair> list_touches(const World& world) {
    std::vector<TouchedPair> list;
    for (const Contact& c : world.contacts)
        list.push_back({{c.plant, c.other, nullptr}, c.capsule, c.gap <= 0 || !c.impulse.isZero(0)});
    for (const PlantContact& c : world.plant_contacts)
        for (size_t k = 0; k < (c.plants[0] == c.plants[1] ? 1 : 2); k++)
            list.push_back({{c.plants[k], c.plants[1 - k], c.plants[1 - k]},
                            c.sides[k].piece,
                            c.depth >= 0 || !c.impulse.isZero(0)});
    return list;
}

bool is_among(const std::vector<Events::Touching>& sorted, const Events::Touching& who) {
    return std::binary_search(sorted.begin(), sorted.end(), who);
}

}  // namespace

void note_touching(World& world) {
    std::vector<Events::Touching>& before = world.events.touching;
    if (!world.events.are_kept) return;
    if (before.empty() && world.contacts.empty() && world.plant_contacts.empty()) return;
    std::vector<Events::Touching> now;
    for (const Events::Touching& who : before)
        if (who.plant->rest.asleep || (who.other_plant && who.other_plant->rest.asleep)) now.push_back(who);
    for (const TouchedPair& touch : list_touches(world)) {
        const bool is_known = is_among(before, touch.who);
        if (!is_known && !touch.pushes) continue;
        const auto is_it = [&](const Events::Touching& who) {
            return who.plant == touch.who.plant && who.other == touch.who.other;
        };
        const bool is_first = std::none_of(now.begin(), now.end(), is_it);
        if (is_first) now.push_back(touch.who);
        if (is_known || !is_first) continue;
        add_event(world, FROND_EVENT_TOUCHED, *touch.who.plant, touch.capsule);
        frond_event_info& info = world.events.list.back();
        info.body = touch.who.other;
        if (touch.who.other_plant) info.other = touch.who.other_plant->handle;
    }
    std::sort(now.begin(), now.end());
    before = std::move(now);
}

void forget_events(World& world, const PlantBody& body) {
    std::deque<frond_event_info>& list = world.events.list;
    const auto is_its = [&](const frond_event_info& event) {
        return event.plant.id == body.handle.id || event.other.id == body.handle.id;
    };
    remove_where(list, is_its);
    std::vector<Events::Touching>& touching = world.events.touching;
    const auto has_it = [&](const Events::Touching& who) { return who.plant == &body || who.other == &body; };
    remove_where(touching, has_it);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
