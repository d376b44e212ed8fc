// In: a sheath and the cage around it. Out: how its nodes and other points of it follow the cage.
#include "cage/tet_geometry.hpp"
#include "core/lists.hpp"
#include "plant/sheath.hpp"

namespace frond {

// Returns the tets that carry the vertices of each capsule; a capsule that has none takes its organ's.
static std::vector<std::vector<int>> tets_of_capsules(const Model& model) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    std::vector<std::vector<int>> by_node(nodes.size()), tets;
    for (size_t v = 0; v < model.chain.vertex_capsule.size(); ++v)
        by_node[size_t(model.chain.vertex_capsule[v])].push_back(model.embedding.tet[v]);
    for (const auto& capsule : model.capsules) {
        std::vector<int> own = by_node[size_t(capsule[1])];
        for (size_t e = 0; own.empty() && e < model.cage.tets.size(); ++e)
            if (model.cage.tet_organ[e] == nodes[size_t(capsule[1])].organ) own.push_back(int(e));
        if (own.empty()) own = model.embedding.tet;
        sort_unique(own);
        tets.push_back(std::move(own));
    }
    return tets;
}

// Returns the attachment to the tet in which a point of the modelled shape lies deepest.
static Attachment attach(const Vec3& place, const std::vector<int>& tets, const Model& model, const TetNodes& nodes) {
    const auto [tet, weights] = deepest_in(model.cage.nodes, model.cage.tets, tets, place);
    return tet_attachment(place_in_tet(nodes, model.cage.tets, tet, weights));
}

// Returns where a hold is in the modelled shape [m].
static Vec3 hold_place(const Attachment& hold, const Model& model) {
    return model.chain.nodes[size_t(hold.node[0] / 2)].position + hold.arm[0];
}

SheathInCage make_sheath_in_cage(const Model& model, const TetNodes& nodes) {
    constexpr int STRIPS = 2;  // a blade in a cage is soft across: tips slip between the corners of one
    SheathInCage in_cage = {make_sheath(model, STRIPS), {}, tets_of_capsules(model), {}};
    const Sheath& sheath = in_cage.sheath;
    for (size_t i = 0; i < sheath.modelled.size(); ++i)
        in_cage.attachments.push_back(
            attach(sheath.modelled[i], in_cage.capsule_tets[size_t(sheath.capsules[i])], model, nodes));
    for (const int node : sheath.corners)
        in_cage.corners.push_back(attach(hold_place(sheath.holds[size_t(node)], model),
                                         in_cage.capsule_tets[size_t(sheath.capsules[size_t(node)])], model, nodes));
    return in_cage;
}

SheathInCage cage_as_sheath(const Model& model) {
    SheathInCage in_cage;
    in_cage.sheath.collider = make_collider(model);
    in_cage.sheath.modelled = model.cage.nodes;
    return in_cage;
}

Attachment sheath_attachment(const SheathInCage& in_cage, const Model& model, const TetNodes& nodes,
                             const ContactSide& side) {
    Vec3 place = Vec3::Zero();
    for (size_t i = 0; i < size_t(side.node_count); ++i)
        place += side.weights[i] * hold_place(in_cage.sheath.holds[size_t(side.nodes[i])], model);
    return attach(place, in_cage.capsule_tets[size_t(side.piece)], model, nodes);
}

}  // namespace frond
