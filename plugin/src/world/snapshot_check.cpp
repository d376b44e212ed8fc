// In: a snapshot that was read, and a world. Out: nothing, or an Error if they do not fit. After this no index of the
// snapshot is out of the world's bounds.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "world/convert.hpp"
#include "world/snapshot.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

[[noreturn]] void damaged(const char* what) {
    fail(FROND_RESULT_FILE_FORMAT, "the snapshot's %s is impossible; it is damaged", what);
}

void check_count(size_t saved, size_t own, const char* what) {
    if (saved != own)
        fail(FROND_RESULT_BAD_ARGUMENT,
             "the snapshot has %zu %s, this world %zu; restore into a world with the same ones", saved, what, own);
}

// Bound on forces, rates and the like, whose products are then still finite.
constexpr double MOST = 1e15;

template <class List>
void check_numbers(const List& numbers, const char* what, double most = MOST) {
    for (const auto& value : numbers)
        if (!(std::abs(double(value)) <= most)) damaged(what);
}

void check_size(const VecX& numbers, Eigen::Index size, const char* what, bool may_be_empty = false) {
    if (numbers.size() != size && !(may_be_empty && numbers.size() == 0)) damaged(what);
    check_numbers(numbers, what);
}

// Checks a contact's direction and its coefficient of friction.
void check_surface(const Vec3& normal, double friction, const char* what) {
    constexpr double SLACK = 1e-5;  // [-], of Bullet's single precision
    if (!(std::abs(normal.squaredNorm() - 1) <= SLACK) || friction < 0) damaged(what);
}

bool are_flags(const std::vector<uint8_t>& bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](uint8_t byte) { return byte <= 1; });
}

// Checks a frame as Bullet has it: axes at right angles, and an origin.
void check_frame(const btTransform& frame, const char* what) {
    constexpr double SLACK = 1e-3;  // [-], Bullet lets single-precision axes drift
    check_numbers(from_bullet(frame.getOrigin()), what, LARGEST_COORDINATE);
    Mat3 basis;
    for (int i = 0; i < 3; i++) basis.row(i) = from_bullet(frame.getBasis()[i]);
    if (!((basis * basis.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() <= SLACK)) damaged(what);
}

void check_index(int index, size_t count, const char* what) {
    if (index < 0 || size_t(index) >= count) damaged(what);
}

// The mechanics that a plant has in the snapshot, which need not be its present ones; nor need it have been broken.
struct Becomes {
    std::shared_ptr<const System> system;
    const Mechanics* row;
    Eigen::Index numbers;  // number of coordinates
};
Becomes becomes(const Plant& plant, const SavedPlant& saved) {
    const size_t fragments = saved.fragments.size();
    const bool stays = saved.which == plant.which && fragments == plant.state.fragments.size();
    auto system = stays ? plant.system : make_system(plant.model, saved.which, plant.input.mass, plant.nodes->order);
    if (!stays && fragments > 0) system = without_fragments(plant, *system, fragments);
    return {system, &mechanics(saved.which, plant.nodes->order), 3 * Eigen::Index(elements_of(*system).node_count)};
}

// Returns whether a body is a fragment that had not come off in the snapshot, so that it goes when that is restored.
bool is_to_go(const Snapshot& snapshot, const Rigid& rigid) {
    if (!rigid.grown_on) return false;
    const std::vector<Rigid*>& all = rigid.grown_on->fragment_bodies;
    const auto place = std::find(all.begin(), all.end(), &rigid) - all.begin();
    return size_t(place) >= snapshot.plants[size_t(rigid.grown_on->index)].fragments.size();
}

// Returns the number of Bullet's objects that stay; those that go have to be the last ones, or the others would change
// places.
size_t count_staying(const World& world, const std::vector<const Rigid*>& going) {
    const int count = world.bullet->getCollisionObjectArray().size() - int(going.size());
    for (const Rigid* rigid : going)
        if (rigid->body->getWorldArrayIndex() < count)
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "a plant broke, and something was made after that; call frond_plant_reset first");
    return size_t(count);
}

void check_foreseen(const Foreseen& foreseen, const char* what) {
    check_numbers(foreseen.place, what);
    check_numbers(std::array{foreseen.most_friction}, what);
    for (const Foreseen::Part& part : foreseen.parts) {
        check_numbers(part.impulse, what);
        check_numbers(std::array{part.work}, what);
        for (const Foreseen::Give& give : part.gives) check_numbers(std::array{give.work}, what);
    }
}

void check_touches(World& world, const Snapshot& snapshot, const SavedTouches& touches, size_t object_count) {
    const btCollisionObjectArray& objects = world.bullet->getCollisionObjectArray();
    for (const SavedContact& saved : touches.with_bodies) {
        const Contact& c = saved.contact;
        check_index(saved.plant, world.bodies.size(), "contacts");
        check_index(c.capsule, world.bodies[size_t(saved.plant)]->capsules().size(), "contacts");
        check_index(saved.other, object_count, "contacts");
        if (PlantBody::of(objects[saved.other])) damaged("contacts");
        for (const Vec3& v : {c.on_plant, c.on_other, c.normal, c.impulse}) check_numbers(v, "contacts");
        check_numbers(std::array{c.along, c.across, c.gap, c.friction}, "contacts");
        check_surface(c.normal, c.friction, "contacts");
        check_foreseen(c.foreseen, "contacts");
    }
    for (const SavedPlantContact& saved : touches.with_plants) {
        const PlantContact& c = saved.contact;
        for (size_t k = 0; k < 2; k++) {
            check_index(saved.plants[k], world.bodies.size(), "contacts of plants");
            const Plant& plant = *world.bodies[size_t(saved.plants[k])]->plant;
            const ContactSide& side = c.sides[k];
            if (side.node_count < 1 || side.node_count > 4) damaged("contacts of plants");
            const int nodes = c.on_chain[k] ? sheath_of(plant)->collider.node_count
                                            : sheath_in_cage_of(plant)->sheath.collider.node_count;
            for (int i = 0; i < side.node_count; i++)
                check_index(side.nodes[size_t(i)], size_t(nodes), "contacts of plants");
            check_index(side.piece, plant.model->capsules.size(), "contacts of plants");
            const Becomes become = becomes(plant, snapshot.plants[size_t(saved.plants[k])]);
            if (!is_sound(c.attachments[k], int(become.numbers / 3))) damaged("contacts of plants");
            check_numbers(side.weights, "contacts of plants");
        }
        for (const Vec3& v : {c.between, c.point, c.normal, c.impulse}) check_numbers(v, "contacts of plants");
        check_numbers(std::array{c.depth, c.friction}, "contacts of plants");
        check_surface(c.normal, c.friction, "contacts of plants");
    }
}

void check_motion(const SavedPlant& saved, const Becomes& becomes) {
    const Motion& motion = saved.state.motion;
    const History& history = motion.history;
    // Bounds places against the plant's own, both in the world. Velocities have no such bound: pins may move any
    // distance in a short step.
    constexpr double FARTHEST = 4 * LARGEST_COORDINATE;
    for (const VecX* numbers : {&motion.x, &motion.v, &motion.pin_target}) {
        check_size(*numbers, becomes.numbers, "motion");
        if (numbers != &motion.v) check_numbers(*numbers, "motion", FARTHEST);
    }
    if (motion.pinned.size() * 3 != size_t(becomes.numbers) || !are_flags(motion.pinned)) damaged("motion");
    // A history that is not valid may be of other mechanics.
    for (const VecX* numbers : {&history.x_end, &history.v_end, &history.x_prev, &history.v_prev})
        check_size(*numbers, history.valid ? becomes.numbers : numbers->size(), "history");
    const bool has_rates = history.valid && history.integrator == FROND_INTEGRATOR_GENERALIZED_ALPHA;
    for (const VecX* numbers : {&history.x_rate, &history.v_rate})
        check_size(*numbers, has_rates ? becomes.numbers : numbers->size(), "history");
    if (history.valid && !(history.h > 0 && std::isfinite(history.h))) damaged("history");
    const Trend& trend = saved.state.trend;
    check_size(trend.v_end, trend.v_end.size(), "trend");
    check_size(trend.rate, trend.v_end.size(), "trend");
    check_size(saved.places, saved.places.size(), "rest");
}

void check_blend_out(const BlendOut& blend_out, Eigen::Index numbers) {
    check_size(blend_out.offset, numbers, "blend-out", true);
    check_size(blend_out.rate, blend_out.offset.size(), "blend-out");
    check_numbers(std::array{blend_out.time}, "blend-out");
}

void check_fragments(const SavedPlant& saved, const PlantBody& body) {
    const Plant& plant = *body.plant;
    bool alike = saved.fragments.size() <= plant.state.fragments.size();  // what broke since joins the plant again
    for (size_t i = 0; alike && i < saved.fragments.size(); i++)
        alike = saved.fragments[i].node == plant.state.fragments[i].node;
    if (!alike)
        fail(FROND_RESULT_BAD_ARGUMENT,
             "plant %d is not broken at the capsules at which it was; call frond_plant_reset and "
             "frond_plant_break first",
             body.index);
    for (const SavedFragment& f : saved.fragments) {
        const FragmentMotion& m = f.motion;
        check_numbers(m.turn.reshaped(), "fragments");
        for (const Vec3& v : {m.shift, m.centre, m.velocity, m.angular_velocity}) check_numbers(v, "fragments");
    }
}

void check_plastic(const SavedPlant& saved, const Becomes& becomes) {
    check_numbers(saved.plastic, "plastic state");
    if (saved.plastic.empty()) return;
    const auto own = becomes.row->copy(elements_of(*becomes.system));
    if (!saved.has_own_elements || becomes.row->get_plastic(*own).size() != saved.plastic.size())
        damaged("plastic state");
}

void check_pins(const SavedPlant& saved, const Plant& plant) {
    constexpr double SLACK = 1e-9;  // [-]
    const size_t nodes = size_t(node_count_of(plant));
    const Pins& pins = saved.input;
    check_size(pins.pin_target, 3 * Eigen::Index(nodes), "pins");
    if (pins.pinned.size() != nodes || !are_flags(pins.pinned) || pins.anchor.size() != nodes) damaged("pins");
    for (int anchor : pins.anchor) check_index(anchor, plant.model->chain.nodes.size(), "pins");
    for (const Support& support : saved.supports) {
        check_index(support.chain_node, plant.model->chain.nodes.size(), "supports");
        for (const Vec3& v : {support.axis, support.place, support.turn})
            check_numbers(v, "supports", LARGEST_COORDINATE);
        if (!(std::abs(support.axis.squaredNorm() - 1) < SLACK)) damaged("supports");
    }
    if (!saved.supports.empty() && !mechanics(saved.which, plant.nodes->order).moves_chain) damaged("supports");
    check_size(saved.forces.on_nodes, 3 * Eigen::Index(nodes), "forces", true);
    check_size(saved.forces.on_chain, 6 * Eigen::Index(plant.model->chain.nodes.size()), "forces", true);
}

void check_plant(const SavedPlant& saved, const PlantBody& body, size_t object_count) {
    const Plant& plant = *body.plant;
    if (saved.kind != kind_of(plant))
        fail(FROND_RESULT_BAD_ARGUMENT,
             "plant %d is of another model, place or setting than in the snapshot; make the same plants in "
             "the same order",
             body.index);
    check_count(saved.grab_targets.size(), plant.input.grabs.size(), "grabs on a plant");
    check_fragments(saved, body);
    const Becomes become = becomes(plant, saved);
    check_size(saved.parted_at, saved.fragments.empty() ? 0 : become.numbers, "fragments");
    check_motion(saved, become);
    check_plastic(saved, become);
    check_pins(saved, plant);
    if (saved.blend.size() > 1) damaged("blend-out");
    for (const Blend& blend : saved.blend) {
        check_blend_out(blend.turns, 6 * Eigen::Index(plant.model->chain.nodes.size()));
        check_blend_out(blend.surface, 3 * Eigen::Index(plant.model->surface.positions.size()));
        check_blend_out(blend.nodes, 3 * Eigen::Index(node_count_of(plant)));
    }
    check_numbers(saved.state.fibre_give, "fibres");
    if (saved.modal.size() > 1 || (!saved.modal.empty() && !mechanics(saved.which, plant.nodes->order).moves_chain))
        damaged("sway");
    for (const ModalState& modal : saved.modal) {
        for (const auto* pair : {&modal.place, &modal.speed, &modal.rest, &modal.damping}) check_numbers(*pair, "sway");
        check_numbers(std::array{modal.since}, "sway");
        check_blend_out(modal.blend_out, become.numbers);
    }
    for (const Vec3& target : saved.grab_targets) check_numbers(target, "grabs", LARGEST_COORDINATE);
    if (saved.state.substeps < 1 || saved.state.substeps > plant.input.max_substeps) damaged("substeps");
    if (saved.level.every < 1 || saved.level.every > 64) damaged("detail");
    check_numbers(std::array{saved.lead, double(saved.state.recovers_for), saved.still, saved.level.pending,
                             double(saved.level.distance), saved.level.disturbed},
                  "plants");
    check_numbers(saved.air, "plants");
    for (const SavedGrownIn& grown_in : saved.grown_in) {
        if (grown_in.capsule != WHOLE_PLANT) check_index(grown_in.capsule, body.capsules().size(), "ground");
        check_index(grown_in.other, object_count, "ground");
        if (!(grown_in.depth >= 0)) damaged("ground");
    }
}

void check_rigid(const SavedRigid& saved, const Rigid& own) {
    if (saved.is_plane != own.is_plane || saved.is_fragment != (own.grown_on != nullptr))
        fail(FROND_RESULT_BAD_ARGUMENT,
             "the rigid bodies differ from those in the snapshot; make the same ones in the same order");
    for (const auto* frame : {&saved.frame, &saved.frame_before}) check_frame(*frame, "rigid bodies");
    for (const auto* v :
         {&saved.velocity, &saved.angular_velocity, &saved.velocity_before, &saved.angular_velocity_before})
        check_numbers(from_bullet(*v), "rigid bodies", LARGEST_COORDINATE);
    for (const auto* v : {&saved.force, &saved.torque}) check_numbers(from_bullet(*v), "rigid bodies");
    if (saved.activation < ACTIVE_TAG || saved.activation > DISABLE_SIMULATION || !std::isfinite(double(saved.still)))
        damaged("rigid bodies");
}

}  // namespace

void check_snapshot(World& world, const Snapshot& snapshot) {
    check_count(snapshot.plants.size(), world.bodies.size(), "plants");
    std::vector<const Rigid*> staying, going;
    for (const std::unique_ptr<Rigid>& rigid : world.rigids)
        (is_to_go(snapshot, *rigid) ? going : staying).push_back(rigid.get());
    check_count(snapshot.rigids.size(), staying.size(), "rigid bodies");
    const size_t object_count = count_staying(world, going);
    check_count(snapshot.bonds.size(), world.bonds.size(), "bonds");
    check_numbers(std::array{snapshot.time, snapshot.travelled}, "time");
    check_numbers(snapshot.gravity_before, "time");
    for (size_t i = 0; i < snapshot.plants.size(); i++) {
        check_plant(snapshot.plants[i], look_at(*world.bodies[i]), object_count);
        check_touches(world, snapshot, snapshot.plants[i].asleep_with, object_count);
    }
    compress_looked_at(world);
    check_touches(world, snapshot, snapshot.touches, object_count);
    for (size_t i = 0; i < snapshot.rigids.size(); i++) check_rigid(snapshot.rigids[i], *staying[i]);
    size_t i = 0;
    for (const Bond& bond : world.bonds) {
        const SavedBond& saved = snapshot.bonds[i++];
        if (saved.vertex != bond.vertex)
            fail(FROND_RESULT_BAD_ARGUMENT,
                 "a bond holds a different point from that in the snapshot; make the same bonds in the same order");
        if (saved.body >= 0) check_index(saved.body, object_count, "bonds");
        check_numbers(saved.impulse, "bonds");
        check_foreseen(saved.foreseen, "bonds");
        if (!(saved.length > 0 && saved.length <= MOST)) damaged("bonds");
    }
    const btCollisionObjectArray& objects = world.bullet->getCollisionObjectArray();
    for (const SavedAhead& ahead : snapshot.ahead) {
        check_index(ahead.body, object_count, "gravity");
        if (!btRigidBody::upcast(objects[ahead.body])) damaged("gravity");
        check_numbers(from_bullet(ahead.force), "gravity");
    }
    for (const int other : snapshot.others_before) check_index(other, object_count, "objects");
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
