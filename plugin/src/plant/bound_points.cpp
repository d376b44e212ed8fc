// Points that follow the cage: vertices of the surface, the chain and its capsules, and their attachments for forces.

#include "plant/plant.hpp"
#include "solve/system.hpp"

namespace frond {

// Uses the shape functions of the cage's elements, even if the mechanics move the chain.
static TetPlace bound_place(const Plant& plant, const Embedding& embedding, size_t i) {
    return place_in_tet(*plant.nodes, plant.model->cage.tets, embedding.tet[i], embedding.weights[i]);
}

static Vec3 bound_point(const Plant& plant, const Embedding& embedding, size_t i, const VecX& x) {
    const TetPlace place = bound_place(plant, embedding, i);
    Vec3 p = Vec3::Zero();
    for (size_t k = 0; k < size_t(place.count); k++) p += place.weight[k] * point(x, place.node[k]);
    return p;
}

Vec3 vertex_position(const Plant& plant, int vertex) {
    const Fragment* fragment = fragment_of_vertex(plant, size_t(vertex));
    const auto in_cage = [&](const VecX& x) { return bound_point(plant, plant.model->embedding, size_t(vertex), x); };
    const auto on_chain = [&](const Follow& follow, const VecX& x) {
        return attachment_place(skin_attachment(follow.skin, follow.skin.vertices[size_t(vertex)]), x);
    };
    if (fragment)
        return fragment->place(fragment->follow ? on_chain(*fragment->follow, fragment->x) : in_cage(fragment->cage_x));
    if (!plant.follow) return plant.to_world(in_cage(cage_places(plant)));
    Vec3 place = on_chain(*plant.follow, plant.view.lead > 0
                                             ? VecX(plant.state.motion.x + plant.view.lead * plant.state.motion.v)
                                             : plant.state.motion.x);
    if (!is_over(plant.state.blend_out)) place += in_cage(blend_offset(plant, plant.view.lead));
    return plant.to_world(place);
}

int nearest_vertex(const Plant& plant, const Vec3& point) {
    int nearest = 0;
    double best = INFINITY;
    for (size_t v = 0; v < plant.model->surface.positions.size(); v++) {
        const double distance = (vertex_position(plant, int(v)) - point).squaredNorm();
        if (distance < best) {
            best = distance;
            nearest = int(v);
        }
    }
    return nearest;
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
