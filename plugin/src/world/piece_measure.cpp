// In: a plant in its present shape. Out: place, radius and friction of its segments.
#include <algorithm>
#include <cmath>

#include "world/piece.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

double radius_of(const PlantBody& body, int capsule) {
    const Flat& flat = body.hull->flats[size_t(capsule)];
    return flat.half_width > 0 ? flat.half_thickness : double(body.capsules()[size_t(capsule)]->getRadius());
}

OnCore nearest_on_core(const PlantBody& body, int capsule, const Vec3& p) {
    const Plant& plant = *body.plant;
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Vec3 a = plant.to_world(plant.chain_positions[size_t(begin)]);
    const Vec3 axis = plant.to_world(plant.chain_positions[size_t(end)]) - a;
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

bool is_covered(const PlantBody& body, int child) {
    return child >= 0 && size_t(child) < body.capsules().size() && body.hull->flats[size_t(child)].half_width > 0;
}

double piece_friction(const PlantBody& body, int capsule) {
    const Model& model = *body.plant->model;
    const int organ = model.chain.nodes[size_t(model.capsules[size_t(capsule)][1])].organ;
    return organ >= 0 ? model.organs[size_t(organ)].material.friction : 0;
}

bool is_between_pieces(const PlantBody& body, int capsule, const Vec3& normal) {
    constexpr double ALONG = 0.5;  // cosine
    if (body.hull->flats[size_t(capsule)].half_width == 0) return false;
    const Plant& plant = *body.plant;
    const auto& [begin, end] = plant.model->capsules[size_t(capsule)];
    const Vec3 axis = plant.chain_positions[size_t(end)] - plant.chain_positions[size_t(begin)];
    const double along = (plant.rotation * axis).dot(normal), least = ALONG * axis.norm();
    if (std::abs(along) < least) return false;
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const auto grows_on = [tip = end](const ChainNode& node) { return node.parent == tip; };
    // At its tip, which nothing continues, a blade can be pushed back.
    return along > 0 || std::any_of(nodes.begin(), nodes.end(), grows_on);
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
