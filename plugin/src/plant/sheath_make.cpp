// In: a model's chain and sections. Out: rings of nodes around the chain's nodes, and tets between two rings.
//
// A blade is at least as thick as the depth that others reach within a step: thinner ones would be passed through
// undetected. A push beside a blade's midrib has a lever across the blade, which turns with the chain's nodes.
#include <algorithm>

#include "cage/tet_geometry.hpp"
#include "plant/flat.hpp"
#include "plant/sheath.hpp"

namespace frond {

namespace {

constexpr double THINNEST = 0.004;  // half the least thickness of a blade [m]

// Half the size of a ring, in width and thickness.
struct Ring {
    Vec3 wide, thin;
    double half_width, half_thickness;  // [m]
    bool is_flat;
};

struct Maker {
    const Model& model;
    int strips;                   // side by side in a blade
    std::vector<Flat> flats;      // one per capsule
    std::vector<int> capsule_of;  // capsule that ends at each chain node; -1: none
    Sheath sheath;
    std::vector<Tet> tets;
    std::vector<int> tet_piece, tet_organ;
};

Ring ring_of(const Maker& maker, int capsule) {
    const Model& model = maker.model;
    const auto& [begin, end] = model.capsules[size_t(capsule)];
    const ChainNode& node = model.chain.nodes[size_t(end)];
    const Vec3 chord = node.position - model.chain.nodes[size_t(begin)].position;
    const Vec3 axis = chord.norm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitY());
    const Flat& flat = maker.flats[size_t(capsule)];
    Ring ring;
    ring.is_flat = flat.half_width > 0;
    ring.wide = ring.is_flat ? flat.wide : Vec3(axis.unitOrthogonal());
    ring.thin = ring.wide.cross(axis).normalized();
    ring.half_width = ring.is_flat ? flat.half_width : node.radius;
    ring.half_thickness = ring.is_flat ? std::max(flat.half_thickness, THINNEST) : node.radius;
    return ring;
}

int strips_of(const Maker& maker, const Ring& ring) {
    return ring.is_flat ? maker.strips : 1;
}

// Adds the corners of a ring around a chain node, two for each edge of a strip; returns the first.
int add_ring(Maker& maker, int chain_node, int capsule, const Ring& ring) {
    const Vec3& middle = maker.model.chain.nodes[size_t(chain_node)].position;
    const int first = int(maker.sheath.modelled.size());
    const int strips = strips_of(maker, ring);
    for (int edge = 0; edge <= strips; edge++) {
        const double across = (2.0 * edge / strips - 1) * ring.half_width;
        for (const double through : {-ring.half_thickness, ring.half_thickness}) {
            Attachment attachment = node_attachment(chain_node, across * ring.wide + through * ring.thin);
            maker.sheath.modelled.push_back(middle + attachment.arm[0]);
            maker.sheath.follow.attachments.push_back(attachment);
            maker.sheath.follow.nearest.push_back(chain_node);
            maker.sheath.capsules.push_back(capsule);
            attachment.arm[0] = ring.is_flat ? Vec3(across * ring.wide) : Vec3(Vec3::Zero());
            maker.sheath.holds.push_back(attachment);
        }
    }
    return first;
}

// Adds six tets around the diagonal from the first corner to the last (Kuhn 1960), so that two boxes in a row share the
// faces between them.
void add_box(Maker& maker, int below, int above, int strip, int capsule) {
    constexpr int WAYS[6][3] = {{4, 2, 1}, {4, 1, 2}, {2, 4, 1}, {2, 1, 4}, {1, 4, 2}, {1, 2, 4}};
    const auto node = [&](int corner) { return (corner & 4 ? above : below) + 2 * strip + (corner & 3); };
    const int end = maker.model.capsules[size_t(capsule)][1];
    for (const auto& way : WAYS) {
        Tet tet = {node(0), node(way[0]), node(way[0] | way[1]), node(7)};
        if (tet_volume(maker.sheath.modelled, tet) < 0) std::swap(tet[1], tet[2]);
        if (!(tet_volume(maker.sheath.modelled, tet) > 0)) continue;
        maker.tets.push_back(tet);
        maker.tet_piece.push_back(capsule);
        maker.tet_organ.push_back(maker.model.chain.nodes[size_t(end)].organ);
    }
}

// Adds a capsule's box, from the last ring of the capsule before, if both are alike, to a new ring.
void add_capsule(Maker& maker, int capsule, std::vector<int>& last_ring, std::vector<Ring>& rings) {
    const Model& model = maker.model;
    const auto& [begin, end] = model.capsules[size_t(capsule)];
    const int before = maker.capsule_of[size_t(begin)];
    Ring ring = ring_of(maker, capsule);
    const bool goes_on = before >= 0 && last_ring[size_t(before)] >= 0 &&
                         rings[size_t(before)].is_flat == ring.is_flat &&
                         model.chain.nodes[size_t(begin)].organ == model.chain.nodes[size_t(end)].organ;
    if (goes_on && ring.wide.dot(rings[size_t(before)].wide) < 0) {
        ring.wide = -ring.wide;
        ring.thin = -ring.thin;
    }
    const int below = goes_on ? last_ring[size_t(before)] : add_ring(maker, begin, capsule, ring);
    last_ring[size_t(capsule)] = add_ring(maker, end, capsule, ring);
    rings[size_t(capsule)] = ring;
    for (int strip = 0; strip < strips_of(maker, ring); strip++) {
        add_box(maker, below, last_ring[size_t(capsule)], strip, capsule);
        const int left = below + 2 * strip, left_above = last_ring[size_t(capsule)] + 2 * strip;
        maker.sheath.strips.push_back(
            {{left, left + 2, left_above, left_above + 2}, capsule, ring.half_thickness, !ring.is_flat});
    }
}

// Lists the corners, and has strips refer to them by their places in that list.
void list_corners(Sheath& sheath) {
    std::vector<int> place(sheath.modelled.size(), -1);
    for (const Strip& strip : sheath.strips)
        for (const int node : strip.corners) {
            if (place[size_t(node)] >= 0) continue;
            place[size_t(node)] = int(sheath.corners.size());
            sheath.corners.push_back(node);
        }
    for (Strip& strip : sheath.strips)
        for (int& corner : strip.corners) corner = place[size_t(corner)];
    for (const int node : sheath.corners) sheath.corner_holds.push_back(sheath.holds[size_t(node)]);
}

}  // namespace

Sheath make_sheath(const Model& model, int strips) {
    Maker maker = {model, strips, make_flats(model), std::vector<int>(model.chain.nodes.size(), -1), {}, {}, {}, {}};
    for (size_t i = 0; i < model.capsules.size(); i++)
        if (model.capsules[i][0] != model.capsules[i][1]) maker.capsule_of[size_t(model.capsules[i][1])] = int(i);
    // Nodes come after their parents, and so do the capsules that end there.
    std::vector<int> last_ring(model.capsules.size(), -1);
    std::vector<Ring> rings(model.capsules.size());
    for (size_t i = 0; i < model.chain.nodes.size(); i++)
        if (maker.capsule_of[i] >= 0) add_capsule(maker, maker.capsule_of[i], last_ring, rings);
    Sheath& sheath = maker.sheath;
    sheath.collider = make_collider(sheath.modelled, maker.tets, maker.tet_piece, maker.tet_organ,
                                    std::max(int(model.capsules.size()), 1));
    separate_near_capsules(model, sheath.collider);
    list_corners(sheath);
    return std::move(sheath);
}

Attachment sheath_attachment(const Sheath& sheath, const ContactSide& side) {
    Attachment attachment;
    attachment.turns = true;
    for (size_t i = 0; i < size_t(side.node_count); i++) {
        const Attachment& hold = sheath.holds[size_t(side.nodes[i])];
        int k = 0;
        while (k < attachment.count && attachment.node[size_t(k)] != hold.node[0]) k++;
        attachment.node[size_t(k)] = hold.node[0];
        attachment.weight[size_t(k)] += side.weights[i];
        attachment.arm[size_t(k)] += side.weights[i] * hold.arm[0];
        attachment.count = std::max(attachment.count, k + 1);
    }
    return attachment;
}

}  // namespace frond
