// In: plants that broke. Out: rigid bodies for their fragments, and the fragments' places.
//
// The body is made of the capsules that came off, with the mass, momentum and angular momentum that the nodes had.
// Bullet moves it, and it collides with plants and other bodies as any other; with the capsules of its own plant in
// which it was when it came off once it has left them.
#include "world/fragments.hpp"

#include <algorithm>

#include "collide/sweep.hpp"
#include "world/convert.hpp"
#include "world/plant_shape.hpp"
#include "world/world.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

namespace {

btMatrix3x3 matrix_to_bullet(const Mat3& m) {
    return btMatrix3x3(btScalar(m(0, 0)), btScalar(m(0, 1)), btScalar(m(0, 2)), btScalar(m(1, 0)), btScalar(m(1, 1)),
                       btScalar(m(1, 2)), btScalar(m(2, 0)), btScalar(m(2, 1)), btScalar(m(2, 2)));
}
Mat3 matrix_from_bullet(const btMatrix3x3& m) {
    Mat3 out;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) out(r, c) = double(m[r][c]);
    return out;
}

// Adds the capsules of a fragment, in the body's frame.
void add_capsules(const PlantBody& body, const Fragment& fragment, const btTransform& frame, Rigid& rigid) {
    const Plant& plant = *body.plant;
    auto compound = std::make_unique<btCompoundShape>();
    for (size_t i = 0; i < body.capsules().size(); i++) {
        if (fragment_of_chain_node(plant, size_t(plant.model->capsules[i][1])) != &fragment) continue;
        const btCapsuleShape& whole = *body.capsules()[i];
        rigid.children.push_back(std::make_unique<btCapsuleShape>(whole.getRadius(), 2 * whole.getHalfHeight()));
        const auto [begin, end] = capsule_ends(plant, i);
        const btTransform place = capsule_frame(plant.to_world(begin), plant.to_world(end));
        compound->addChildShape(frame.inverse() * place, rigid.children.back().get());
    }
    rigid.shape = std::move(compound);
}

// Returns whether a fragment is in what is left of its plant, or touches it, blades by their plates.
bool is_in_plant(const PlantBody& body, const Fragment& fragment) {
    constexpr double TOUCH = 0.001;  // [m]
    const Plant& plant = *body.plant;
    BoxSet boxes;
    std::vector<Capsule> capsules;
    for (size_t i = 0; i < body.capsules().size(); i++) {
        const Fragment* of = fragment_of_chain_node(plant, size_t(plant.model->capsules[i][1]));
        if (of && of != &fragment) continue;
        const auto [begin, end] = capsule_ends(plant, i);
        const double radius = std::max(double(body.capsules()[i]->getRadius()), body.hull->flats[i].half_width);
        capsules.push_back({begin, end, radius});
        boxes.boxes.push_back(box_around(capsules.back(), 0.5 * TOUCH));
        boxes.boxes.back().group = of ? 1 : 0;
    }
    const std::vector<std::array<int, 2>> pairs = find_pairs_by_sweep(boxes);
    return std::any_of(pairs.begin(), pairs.end(), [&](const std::array<int, 2>& pair) {
        return gap_between(capsules[size_t(pair[0])], capsules[size_t(pair[1])]).distance < TOUCH;
    });
}

double friction_of(const Model& model, int chain_node) {
    const int organ = model.chain.nodes[size_t(chain_node)].organ;
    return organ >= 0 ? model.organs[size_t(organ)].material.friction : 0;
}

Rigid* add_fragment(World& world, PlantBody& body, const Fragment& fragment) {
    const Plant& plant = *body.plant;
    auto rigid = std::make_unique<Rigid>();
    rigid->world = &world;
    rigid->is_plane = false;
    rigid->grown_on = &body;

    // A body's frame lies along its principal axes in Bullet.
    const Mat3& turn = fragment.axes;
    rigid->grown_turn = turn.transpose() * plant.rotation.toRotationMatrix();
    rigid->grown_shift = turn.transpose() * (plant.position - fragment.centre);
    const btTransform frame(matrix_to_bullet(turn), to_bullet(fragment.centre));
    add_capsules(body, fragment, frame, *rigid);
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(fragment.mass), nullptr, rigid->shape.get(),
                                                  to_bullet(fragment.moments));
    info.m_startWorldTransform = frame;
    info.m_friction = btScalar(friction_of(*plant.model, fragment.node));
    rigid->body = lend<btRigidBody>(*rigid, info);
    rigid->body->setLinearVelocity(to_bullet(fragment.velocity));
    rigid->body->setAngularVelocity(to_bullet(fragment.angular_velocity));
    world.bullet->addRigidBody(rigid->body.get());
    world.rigids.push_back(std::move(rigid));
    return world.rigids.back().get();
}

}  // namespace

void break_off(World& world, PlantBody& body, int chain_node) {
    const Fragment& fragment = break_off(*body.plant, chain_node);
    body.fragment_bodies.push_back(add_fragment(world, body, fragment));
    const auto& capsules = body.plant->model->capsules;
    const auto ends = [&](const std::array<int, 2>& capsule) { return capsule[1] == chain_node; };
    const auto capsule = std::find_if(capsules.begin(), capsules.end(), ends);
    add_event(world, FROND_EVENT_BROKE, body, int(capsule - capsules.begin()));
}

int break_overloaded(World& world, PlantBody& body) {
    const int node = find_break(*body.plant);
    if (node < 0) return 0;
    break_off(world, body, node);
    return 1;
}

void carry_fragments(PlantBody& body) {
    for (size_t k = 0; k < body.fragment_bodies.size(); k++) {
        Rigid& rigid = *body.fragment_bodies[k];
        const btTransform& now = rigid.body->getWorldTransform();
        const Mat3 turn = matrix_from_bullet(now.getBasis());
        Fragment& fragment = body.plant->state.fragments[k];
        fragment.turn = turn * rigid.grown_turn;
        fragment.centre = from_bullet(now.getOrigin());
        fragment.shift = turn * rigid.grown_shift + fragment.centre;
        fragment.velocity = from_bullet(rigid.body->getLinearVelocity());
        fragment.angular_velocity = from_bullet(rigid.body->getAngularVelocity());
        if (!rigid.has_left) rigid.has_left = !is_in_plant(body, fragment);
    }
}

// Pulls by implicit Euler, so that a stiff spring is stable.
void pull_fragments(PlantBody& body, double h) {
    const Plant& plant = *body.plant;
    for (const Grab& grab : plant.input.grabs) {
        const Fragment* fragment = fragment_of_vertex(plant, size_t(grab.vertex));
        if (!fragment) continue;
        btRigidBody& rigid = *body.fragment_bodies[size_t(fragment - plant.state.fragments.data())]->body;
        const Vec3 point = vertex_position(plant, grab.vertex);
        const btVector3 arm = to_bullet(point) - rigid.getCenterOfMassPosition();
        const Vec3 way = grab.target - point - h * from_bullet(rigid.getVelocityInLocalPoint(arm));
        if (!(way.norm() > 0)) continue;
        const btScalar lightness = rigid.computeImpulseDenominator(to_bullet(point), to_bullet(Vec3(way.normalized())));
        const double soft = 1 + h * h * grab.stiffness * double(lightness);
        rigid.activate(true);
        rigid.applyImpulse(to_bullet(Vec3(h * grab.stiffness / soft * way)), arm);
    }
}

bool is_apart(const PlantBody& body, int capsule, const btCollisionObject& other) {
    if (body.fragment_bodies.empty()) return false;
    if (has_come_off(*body.plant, capsule)) return true;
    return std::any_of(body.fragment_bodies.begin(), body.fragment_bodies.end(),
                       [&](const Rigid* fragment) { return fragment->body.get() == &other && !fragment->has_left; });
}

void remove_fragments(World& world, PlantBody& body, size_t first) {
    for (size_t k = first; k < body.fragment_bodies.size(); k++) remove_rigid(world, body.fragment_bodies[k]);
    body.fragment_bodies.resize(std::min(first, body.fragment_bodies.size()));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
