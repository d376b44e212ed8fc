// In: rows and their impulses. Out: velocities of the bodies once these have pushed them, and their work on plants.
#include "contact/bodies_go_on.hpp"

#include "contact/coupled_rows.hpp"
#include "contact/find_contacts.hpp"
#include "contact/foresee.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

static Vec3 velocity_after(const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses,
                           const ContactRow& at) {
    Vec3 after = at.contact_body.velocity;
    for (size_t k = 0; k < rows.size(); k++)
        if (are_one_body(at, rows[k])) after -= compliance_between(at.contact_body, rows[k].contact_body) * impulses[k];
    return after;
}

void go_on(const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses) {
    for (const ContactRow& at : rows)
        if (at.contact) at.contact->pushed_on = velocity_after(rows, impulses, at);
}

void count_work_of_bodies(const World& world, const std::vector<ContactRow>& rows, const std::vector<Vec3>& impulses) {
    for (size_t i = 0; i < rows.size(); i++) {
        const ContactRow& at = rows[i];
        if (!at.work) continue;
        const Vec3 velocity = velocity_as_moved(world, at.contact_body);
        const bool is_slowed = is_movable(at) && pushes_back(world, *at.plants[0]);
        const Vec3 mean = is_slowed ? Vec3(0.5 * (velocity + velocity_after(rows, impulses, at))) : velocity;
        const ContactPush* push = at.plants[0]->plant->step.push.get();
        const double taken = is_slowed || !push ? 1 : push->gone;
        *at.work = taken * impulses[i].dot(mean + at.touch.wanted);
    }
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
