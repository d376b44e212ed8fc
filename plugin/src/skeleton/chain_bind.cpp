// In: slabs and the nodes that they became. Out: the capsule of each vertex, and its place along that.
#include "skeleton/chain_bind.hpp"

#include <algorithm>

namespace frond {

namespace {

struct Binding {
    const Surface& surface;
    const Bands& bands;
    const ChainTree& tree;
    const SlabNodes& slabs;
    Chain& chain;
};

// Returns the place on a capsule nearest to a point, 0 at its begin and 1 at its end.
double nearest_along(const Chain& chain, int node, const Vec3& place) {
    const int parent = chain.nodes[size_t(node)].parent;
    if (parent < 0) return 1;
    const Vec3 begin = chain.nodes[size_t(parent)].position, axis = chain.nodes[size_t(node)].position - begin;
    const double square = axis.squaredNorm();
    return square > 0 ? std::clamp((place - begin).dot(axis) / square, 0.0, 1.0) : 1;
}

// Returns where slabs begin, as shares of the way along their capsules. A slab that grows across a level line begins
// with its capsule; others where they are nearest to its begin, because the capsule begins within what they grow from.
// Slabs that joined a capsule are at one place of it, at its end if something else grows from them.
std::vector<double> begins_of_slabs(const Binding& binding) {
    std::vector<double> along(binding.bands.pieces.size(), 1.0);
    for (int number : binding.tree.order) {
        const Shoot& shoot = binding.tree.shoots[size_t(number)];
        const Piece& piece = binding.bands.pieces[size_t(number)];
        const bool own = binding.slabs.owns[size_t(number)];
        if (shoot.parent < 0) {
            along[size_t(number)] = own ? 0 : 1;
            continue;
        }
        const SlabLink& link = binding.tree.links[size_t(shoot.link)];
        const int node = binding.slabs.node[size_t(number)];
        const auto place = [&](const Vec3& p) { return nearest_along(binding.chain, node, p); };
        double& begin = along[size_t(number)];
        if (own)
            begin = link.level ? 0 : place(shoot.down ? piece.far_end : piece.near_end);
        else if (shoot.children > 0)
            begin = 1;
        else if (link.level)
            begin = binding.slabs.owns[size_t(shoot.parent)] ? 1 : along[size_t(shoot.parent)];
        else
            begin = place(link.middle);
    }
    return along;
}

// Assigns a vertex to its own slab's capsule, and to the nearer end of that. `x` is its distance from the start of its
// component [m].
void bind_vertex(const Binding& binding, const std::vector<double>& begins, size_t vertex, int number, double x) {
    Chain& chain = binding.chain;
    const Shoot& shoot = binding.tree.shoots[size_t(number)];
    const Piece& piece = binding.bands.pieces[size_t(number)];
    const int node = binding.slabs.node[size_t(number)], parent = chain.nodes[size_t(node)].parent;
    const bool own = binding.slabs.owns[size_t(number)];
    const double way = piece.far - piece.near, share = way > 0 ? std::clamp((x - piece.near) / way, 0.0, 1.0) : 1;
    const double begin = begins[size_t(number)], grown = shoot.down ? 1 - share : share;
    chain.vertex_capsule[vertex] = node;
    chain.vertex_along[vertex] = own ? begin + (1 - begin) * grown : begin;
    const bool goes_on = shoot.parent < 0 || binding.slabs.node[size_t(shoot.parent)] != node;
    const bool nearer_to_parent = (x < 0.5 * (piece.near + piece.far)) != shoot.down;
    chain.vertex_node[vertex] = goes_on && parent >= 0 && nearer_to_parent ? parent : node;
    if (binding.slabs.last_resort < 0) return;
    chain.vertex_capsule[vertex] = binding.slabs.last_resort;
    chain.vertex_along[vertex] = nearest_along(chain, binding.slabs.last_resort, binding.surface.positions[vertex]);
}

}  // namespace

void bind_vertices(const Surface& surface, const Topology& topology, const Bands& bands, const ChainTree& tree,
                   const SlabNodes& slabs, Chain& chain) {
    chain.vertex_node.assign(surface.positions.size(), 0);
    chain.vertex_capsule.assign(surface.positions.size(), 0);
    chain.vertex_along.assign(surface.positions.size(), 0);
    const Binding binding = {surface, bands, tree, slabs, chain};
    const std::vector<double> begins = begins_of_slabs(binding);
    std::vector<char> bound(surface.positions.size(), 0);
    for (size_t t = 0; t < surface.triangles.size(); t++)
        for (size_t k = 0; k < 3; k++) {
            const size_t vertex = size_t(surface.triangles[t][k]);
            if (bound[vertex]) continue;
            bound[vertex] = 1;
            const double x =
                bands.distance[size_t(topology.triangles[t][k])] - bands.entry[size_t(topology.triangle_component[t])];
            bind_vertex(binding, begins, vertex, bands.piece_at(int(t), x), x);
        }
}

}  // namespace frond
