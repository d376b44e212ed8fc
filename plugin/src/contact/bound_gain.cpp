// In: rows whose impulses plants have taken, and the ways that these went. Out: impulses by which no movable body gains
// more energy than its own took from the plants, than closing bonds takes, and than lifting it takes as fast as it
// parts from overlaps; a link, which has motors, as much as parting takes.
//
// Between linear responses impulses give no energy. But a plant whose step was solved again, or held back, went another
// way than its linear response, and a chain of links turns a small wrong impulse into a fast spin.
#include "contact/bound_gain.hpp"

#include <algorithm>
#include <cmath>

#include "contact/coupled_rows.hpp"
#include "core/assert.hpp"
#include "plant/plant_step.hpp"
#include "world/link_loads.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

// Returns the rows of one body, from `first` on.
std::vector<size_t> rows_of_body(const std::vector<ContactRow>& rows, size_t first) {
    std::vector<size_t> all;
    for (size_t i = first; i < rows.size(); i++)
        if (are_one_body(rows[first], rows[i])) all.push_back(i);
    return all;
}

// Returns the share of impulses by which a body gains `most` [J], or all if they give less: it gains
// first share + second share^2.
double share_within(double first, double second, double most) {
    if (first + second <= most || !(second > 0)) return 1;
    return std::clamp((-first + std::sqrt(std::max(0.0, first * first + 4 * second * most))) / (2 * second), 0.0, 1.0);
}

double share_of_body(const World& world, const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses,
                     const std::vector<size_t>& body, double h) {
    double first = 0, second = 0, taken = 0, parted = 0;
    for (const size_t i : body) {
        const Vec3 on_body = -impulses[i];
        const ContactBody& at = rows[i].contact_body;
        first += on_body.dot(at.velocity);
        for (const size_t k : body)
            second -= 0.5 * on_body.dot(compliance_between(at, rows[k].contact_body) * impulses[k]);
        const Plant& plant = *rows[i].plants[0]->plant;
        FROND_ASSERT(plant.step.push);
        const Vec3 velocity = way_of_touch(plant, rows[i].touches[0]) / h;
        taken += on_body.dot(velocity - rows[i].touch.wanted);
        parted += asked_work(rows[i], impulses[i]);
    }
    // A plant that is held back asks a heavy body in it for ever more.
    const btRigidBody* rigid = rows[body[0]].contact_body.rigid;
    taken += rigid ? std::min(parted, parting_work(1 / double(rigid->getInvMass()), h)) : parted;
    // What a link has already, as the impulses that Bullet foresaw were taken back, is its motors'.
    const btMultiBodyLinkCollider* link = rows[body[0]].contact_body.link;
    const LinkLoads* loads = link ? find_link_loads(world, *link->m_multiBody) : nullptr;
    return share_within(first, second, std::max(0.0, taken) - (loads ? loads->taken.energy : 0));
}

}  // namespace

bool bound_gain(const World& world, const std::vector<ContactRow>& rows, double h, std::vector<Vec3>& impulses) {
    bool any = false;
    std::vector<uint8_t> done(rows.size(), 0);
    for (size_t first = 0; first < rows.size(); first++) {
        if (done[first] || !is_movable(rows[first])) continue;
        const std::vector<size_t> body = rows_of_body(rows, first);
        const double share = share_of_body(world, rows, impulses, body, h);
        any |= share < 1;
        for (const size_t i : body) {
            done[i] = 1;
            if (share < 1) impulses[i] *= share;
        }
    }
    return any;
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
