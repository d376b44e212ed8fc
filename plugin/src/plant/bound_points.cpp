// Points that follow the cage: vertices of the surface, the chain and its capsules, and their attachments for forces.

#include <algorithm>

#include "plant/seen.hpp"
#include "solve/system.hpp"

namespace frond {

// Uses the shape functions of the cage's elements, even if the mechanics move the chain.
static TetPlace bound_place(const Plant& plant, const Embedding& embedding, size_t i) {
    return place_in_tet(*plant.nodes, plant.model->cage.tets, embedding.tet[i], embedding.weights[i]);
}

Vec3 bound_point(const Plant& plant, const Embedding& embedding, size_t i, const VecX& x) {
    const TetPlace place = bound_place(plant, embedding, i);
    Vec3 p = Vec3::Zero();
    for (size_t k = 0; k < size_t(place.count); k++) p += place.weight[k] * point(x, place.node[k]);
    return p;
}

// Returns how the plant looks at the end of its step, or extrapolated until it is stepped again.
static Look look_now(const Plant& plant) {
    const Motion& motion = plant.state.motion;
    if (plant.view.lead == 0) return look_of(plant, motion.x, 0);
    return look_of(plant, motion.x + plant.view.lead * motion.v, plant.view.lead);
}

static Vec3 vertex_now(const Plant& plant, const Look& look, size_t vertex) {
    const Fragment* fragment = fragment_of_vertex(plant, vertex);
    if (!fragment) return plant.to_world(vertex_in(plant, look, vertex));
    if (!fragment->follow) return fragment->place(bound_point(plant, plant.model->embedding, vertex, fragment->cage_x));
    const Skin& skin = fragment->follow->skin;
    return fragment->place(attachment_place(skin_attachment(skin, skin.vertices[vertex]), fragment->x));
}

Vec3 vertex_position(const Plant& plant, int vertex) {
    return vertex_now(plant, look_now(plant), size_t(vertex));
}

std::vector<Vec3> vertex_positions(const Plant& plant) {
    const Look look = look_now(plant);
    std::vector<Vec3> positions(plant.model->surface.positions.size());
    for (size_t v = 0; v < positions.size(); v++) positions[v] = vertex_now(plant, look, v);
    return positions;
}

int nearest_vertex(const Plant& plant, const Vec3& point) {
    const std::vector<Vec3> positions = vertex_positions(plant);
    const auto is_nearer = [&](const Vec3& a, const Vec3& b) {
        return (a - point).squaredNorm() < (b - point).squaredNorm();
    };
    return int(std::min_element(positions.begin(), positions.end(), is_nearer) - positions.begin());
}

// Returns a chain node carried by a cage. A node whose tet is gone moves with its parent.
static Vec3 chain_point(const Plant& plant, size_t i) {
    const Embedding& embedding = plant.model->chain_embedding;
    const int parent = plant.model->chain.nodes[i].parent;
    const std::vector<int>& of_tet = plant.state.parting->of_tet;
    const int fragment = of_tet.empty() ? -1 : of_tet[size_t(embedding.tet[i])];
    if (fragment < 0 || parent < 0) return bound_point(plant, embedding, i, plant.state.motion.x);
    const std::vector<Vec3>& then = plant.state.fragments[size_t(fragment)].chain_x;
    return plant.view.chain_positions[size_t(parent)] + then[i] - then[size_t(parent)];
}

void update_chain(Plant& plant) {
    const size_t count = plant.model->chain.nodes.size();
    plant.view.chain_positions.resize(count);
    const VecX& x = plant.state.motion.x;
    if (plant.follow && plant.state.fragments.empty()) {
        for (size_t i = 0; i < count; i++) plant.view.chain_positions[i] = point(x, int(2 * i));
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const Fragment* fragment = fragment_of_chain_node(plant, i);
        plant.view.chain_positions[i] = fragment       ? plant.to_model(fragment->place(fragment->chain_x[i]))
                                        : plant.follow ? Vec3(point(x, int(2 * i)))
                                                       : chain_point(plant, i);
    }
}

// Returns the ends; a capsule that came off begins where it broke.
std::array<Vec3, 2> capsule_ends(const Plant& plant, size_t capsule) {
    const auto& [begin, end] = plant.model->capsules[capsule];
    const Fragment* fragment = fragment_of_chain_node(plant, size_t(end));
    return {fragment ? plant.to_model(fragment->place(fragment->chain_x[size_t(begin)]))
                     : plant.view.chain_positions[size_t(begin)],
            plant.view.chain_positions[size_t(end)]};
}

Attachment chain_attachment(const Plant& plant, int node) {
    return plant.system->chain[size_t(node)];
}

Attachment vertex_attachment(const Plant& plant, int vertex) {
    if (plant.follow) return skin_attachment(plant.follow->skin, plant.follow->skin.vertices[size_t(vertex)]);
    return tet_attachment(bound_place(plant, plant.model->embedding, size_t(vertex)));
}

}  // namespace frond
