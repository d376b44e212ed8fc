// In: a model. Out: how its surface hangs on the capsules of its chain.
#include "plant/skin.hpp"

#include <algorithm>
#include <numeric>

#include "core/assert.hpp"

namespace frond {

// Sets each vertex's gradient to the mean over the triangles around it on the same capsule, weighted by area.
static void find_gradients(const Surface& surface, std::vector<SkinVertex>& vertices) {
    std::vector<Vec3> sum(vertices.size(), Vec3::Zero());
    std::vector<double> area(vertices.size(), 0.0);
    for (const Triangle& t : surface.triangles) {
        const size_t i[] = {size_t(t[0]), size_t(t[1]), size_t(t[2])};
        if (vertices[i[1]].node != vertices[i[0]].node || vertices[i[2]].node != vertices[i[0]].node) continue;
        const Vec3 &a = surface.positions[i[0]], &b = surface.positions[i[1]], &c = surface.positions[i[2]];
        const Vec3 normal = (b - a).cross(c - a);
        const double square = normal.squaredNorm();
        if (!(square > 0)) continue;
        const double to_b = vertices[i[1]].along - vertices[i[0]].along,
                     to_c = vertices[i[2]].along - vertices[i[0]].along;
        const double weight = std::sqrt(square);
        const Vec3 gradient = (to_b * (c - a).cross(normal) + to_c * normal.cross(b - a)) / square;
        for (size_t v : i) {
            sum[v] += weight * gradient;
            area[v] += weight;
        }
    }
    for (size_t v = 0; v < vertices.size(); ++v)
        if (area[v] > 0) vertices[v].gradient = (sum[v] / area[v]).cast<float>();
}

Skin make_skin(const Model& model) {
    const Chain& chain = model.chain;
    Skin skin;
    for (size_t i = 0; i < chain.nodes.size(); ++i) {
        const int parent = chain.nodes[i].parent;
        skin.parents.push_back(parent < 0 ? int(i) : parent);
    }
    for (const ChainLoop& loop : chain.loops) skin.parents[size_t(loop.above)] = loop.below;
    for (size_t i = 0; i < chain.nodes.size(); ++i)
        skin.axes.push_back(chain.nodes[i].position - chain.nodes[size_t(skin.parents[i])].position);
    for (size_t v = 0; v < chain.vertex_capsule.size(); ++v) {
        const int node = chain.vertex_capsule[v];
        const double along = chain.vertex_along[v];
        FROND_ASSERT(node >= 0 && size_t(node) < chain.nodes.size() && along >= 0 && along <= 1);
        const Vec3& begin = chain.nodes[size_t(skin.parents[size_t(node)])].position;
        const Vec3 across = model.surface.positions[v] - begin - along * skin.axes[size_t(node)];
        skin.vertices.push_back({node, along, across, Vec3f::Zero()});
    }
    find_gradients(model.surface, skin.vertices);
    skin.by_capsule.resize(skin.vertices.size());
    std::iota(skin.by_capsule.begin(), skin.by_capsule.end(), 0);
    std::stable_sort(skin.by_capsule.begin(), skin.by_capsule.end(),
                     [&](int a, int b) { return skin.vertices[size_t(a)].node < skin.vertices[size_t(b)].node; });
    return skin;
}

Attachment skin_attachment(const Skin& skin, const SkinVertex& vertex) {
    const int b = vertex.node, a = skin.parents[size_t(b)];
    const double s = vertex.along;
    if (!(s > 0 && s < 1)) return node_attachment(s > 0 ? b : a, vertex.across);
    return centre_line_attachment(a, b, skin.axes[size_t(b)], s, vertex.across);
}

}  // namespace frond
