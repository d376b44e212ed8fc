// In: a plant in its present shape. Out: place, radius and friction of its segments.
#include <algorithm>
#include <cmath>

#include "contact/piece.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

double radius_of(const PlantBody& body, int capsule) {
    const Flat& flat = body.hull->flats[size_t(capsule)];
    return flat.half_width > 0 ? flat.half_thickness : double(body.capsules()[size_t(capsule)]->getRadius());
}

OnCore nearest_on_core(const PlantBody& body, int capsule, const Vec3& p) {
    const Plant& plant = *body.plant;
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Vec3 a = plant.to_world(plant.view.chain_positions[size_t(begin)]);
    const Vec3 axis = plant.to_world(plant.view.chain_positions[size_t(end)]) - a;
    const double square = axis.squaredNorm();
    const double along = square > 0 ? std::clamp((p - a).dot(axis) / square, 0.0, 1.0) : 0.0;
    OnCore core = {a + along * axis, along, 0};
    const Flat& flat = body.hull->flats[size_t(capsule)];
    Mat3 frame;
    if (flat.half_width == 0 || !piece_frame(plant, end, flat.wide, flat.spread, frame)) return core;
    const Vec3 wide = plant.rotation * frame.col(2);
    const double most = flat.half_width - flat.half_thickness;
    core.across = std::clamp((p - core.point).dot(wide), -most, most);
    core.point += core.across * wide;
    return core;
}

// Calls `take` for the segments that meet a segment at one of its chain nodes.
template <class F>
static void for_joined(const PlantBody& body, int capsule, size_t end, const F& take) {
    const std::vector<std::array<int, 2>>& ends = body.plant->model->capsules;
    const int joint = ends[size_t(capsule)][end];
    for (size_t i = 0; i < ends.size(); i++)
        if (int(i) != capsule && (ends[i][0] == joint || ends[i][1] == joint)) take(int(i));
}

bool are_joined(const Plant& plant, int capsule, int other) {
    const auto &a = plant.model->capsules[size_t(capsule)], &b = plant.model->capsules[size_t(other)];
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

int piece_under(const PlantBody& body, int capsule, const Vec3& p) {
    constexpr int MOST = 16;  // segments that a body's point may have gone on since it was found
    for (int steps = 0; steps < MOST; steps++) {
        const OnCore core = nearest_on_core(body, capsule, p);
        if (core.along > 0 && core.along < 1) break;
        double least = (core.point - p).squaredNorm();
        const int from = capsule;
        for_joined(body, from, core.along > 0 ? 1 : 0, [&](int other) {
            const double square = (nearest_on_core(body, other, p).point - p).squaredNorm();
            if (square >= least) return;
            least = square;
            capsule = other;
        });
        if (capsule == from) break;
    }
    return capsule;
}

bool is_in_joint(const PlantBody& body, int capsule, const Vec3& p) {
    constexpr double WITHIN = 0.9999;  // of the other segment's radius, so that a corner of a bent stem is outside
    const double along = nearest_on_core(body, capsule, p).along;
    bool is_in = false;
    if (along > 0 && along < 1) return is_in;
    for_joined(body, capsule, along > 0 ? 1 : 0, [&](int other) {
        is_in |= (nearest_on_core(body, other, p).point - p).norm() < WITHIN * radius_of(body, other);
    });
    return is_in;
}

bool is_covered(const PlantBody& body, int child) {
    return child >= 0 && size_t(child) < body.capsules().size() && body.hull->flats[size_t(child)].half_width > 0;
}

void set_surface_of(Contact& contact) {
    const Model& model = *contact.plant->plant->model;
    const int organ = model.chain.nodes[size_t(model.capsules[size_t(contact.capsule)][1])].organ;
    if (organ < 0) return;
    const Material& material = model.organs[size_t(organ)].material;
    contact.friction = material.friction * double(contact.other->getFriction());
    contact.restitution = material.restitution * double(contact.other->getRestitution());
}

bool is_between_pieces(const PlantBody& body, int capsule, const Vec3& normal) {
    constexpr double ALONG = 0.5;  // cosine
    if (body.hull->flats[size_t(capsule)].half_width == 0) return false;
    const Plant& plant = *body.plant;
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Vec3 axis = plant.view.chain_positions[size_t(end)] - plant.view.chain_positions[size_t(begin)];
    const double along = (plant.rotation * axis).dot(normal), least = ALONG * axis.norm();
    if (std::abs(along) < least) return false;
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const auto grows_on = [tip = end](const ChainNode& node) { return node.parent == tip; };
    // At its tip, which nothing continues, a blade can be pushed back.
    return along > 0 || std::any_of(nodes.begin(), nodes.end(), grows_on);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
