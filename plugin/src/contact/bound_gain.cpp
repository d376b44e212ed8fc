// In: the impulses that an island's movable bodies are to get. Out: the share of them by which the bodies gain no more
// energy than the plants have.
//
// Impulses between linear responses give none, but a plant's linear response to its own strain is not bounded by the
// energy of that strain, and a chain of links turns a small wrong impulse into a fast spin.
#include <algorithm>
#include <cmath>

#include "contact/contact_body.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

double stored_at_start(const Plant& plant) {
    if (plant.step.x_good.size() != plant.state.motion.x.size()) return INFINITY;
    const bool is_driven = plant.input.has_user_force || !plant.input.grabs.empty() ||
                           !plant.input.pin_springs.empty() ||
                           is_carried(plant.state.motion, plant.step.x_good, plant.step.v_good);
    if (is_driven) return INFINITY;
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const VecX &mass = node_mass_of(*plant.system), &v = plant.step.v_good;
    double kinetic = 0;
    for (Eigen::Index i = 0; i < mass.size() && 3 * i < v.size(); i++)
        kinetic += 0.5 * mass[i] * point(v, int(i)).squaredNorm();
    return row.energy(elements_of(plant), plant.step.x_good) + kinetic;
}

double share_within(const std::vector<BodyPush>& pushes, const std::function<double()>& allowed) {
    constexpr double NO_MATTER = 0.01;  // [J]
    double first = 0, second = 0;       // of the energy in powers of the share [J]
    for (const BodyPush& push : pushes) first += push.impulse.dot(push.body->velocity);
    for (const BodyPush& at : pushes)
        for (const BodyPush& by : pushes)
            second += 0.5 * at.impulse.dot(compliance_between(*at.body, *by.body) * by.impulse);
    if (first + second <= NO_MATTER) return 1;
    const double most = NO_MATTER + allowed();
    if (first + second <= most || !(second > 0)) return 1;
    return std::clamp((-first + std::sqrt(first * first + 4 * second * most)) / (2 * second), 0.0, 1.0);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
