// In: contacts of the last substep and of this one. Out: this substep's contacts whose regions agree on a side.
#include "contact/agree_on_sides.hpp"

#include <algorithm>
#include <map>

#include "world/plant_body.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

using Piece = std::array<int, 2>;     // plant number and region number
using Pieces = std::array<Piece, 2>;  // lower one first

struct Sided {
    Pieces pieces;
    Vec3 way;  // exit direction of the lower region from the other one, times the overlap's depth [m]
};
Sided sided(const PlantContact& contact) {
    const Piece first = {contact.plants[0]->number, contact.sides[0].piece};
    const Piece second = {contact.plants[1]->number, contact.sides[1].piece};
    const Vec3 way = contact.depth * contact.normal;
    return first < second ? Sided{{first, second}, way} : Sided{{second, first}, -way};
}

using Ways = std::map<Pieces, Vec3>;

Ways ways_of(const std::vector<const PlantContact*>& contacts) {
    Ways ways;
    for (const PlantContact* contact : contacts) {
        if (contact->depth <= 0) continue;
        const Sided of = sided(*contact);
        ways.emplace(of.pieces, Vec3::Zero()).first->second += of.way;
    }
    return ways;
}

// Takes the deepest contact's direction for pairs without one from the last substep, and for pairs that overlap deeply
// if the contacts against their last direction are much deeper than those along it.
void overrule(const std::vector<PlantContact>& contacts, Ways& ways) {
    constexpr double FAR = 2, DEEP = 0.005;         // [-], [m]
    std::map<Pieces, std::array<Vec3, 2>> deepest;  // along and against the last direction
    for (const PlantContact& contact : contacts) {
        if (contact.depth <= 0) continue;
        const Sided of = sided(contact);
        const auto known = ways.find(of.pieces);
        const bool is_against = known != ways.end() && of.way.dot(known->second) < 0;
        Vec3& most =
            deepest.emplace(of.pieces, std::array{Vec3(Vec3::Zero()), Vec3(Vec3::Zero())}).first->second[is_against];
        if (of.way.norm() > most.norm()) most = of.way;
    }
    for (const auto& [pieces, most] : deepest) {
        const auto [known, is_new] = ways.emplace(pieces, most[0]);
        if (!is_new && known->second.norm() >= DEEP && most[1].norm() > FAR * most[0].norm()) known->second = most[1];
    }
}

}  // namespace

void agree_on_sides(const std::vector<const PlantContact*>& last, std::vector<PlantContact>& contacts) {
    constexpr double SHALLOW = 0.001, AGAINST = -0.3;  // [m], a cosine
    Ways ways = ways_of(last);
    overrule(contacts, ways);
    const auto is_against = [&](const PlantContact& contact) {
        if (contact.depth <= SHALLOW) return false;
        const Sided of = sided(contact);
        const Vec3& way = ways.at(of.pieces);
        return of.way.dot(way) < AGAINST * of.way.norm() * way.norm();
    };
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(), is_against), contacts.end());
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
