// In: tets and which nodes are held. Out: which tets cannot move without straining. Tets that share only a node or an
// edge are hinged there, and a hinge carries no bending: its stiffness matrix is singular, up to rounding.
#include "calibration/firm_tets.hpp"

#include <algorithm>
#include <map>

#include "core/union_find.hpp"

namespace frond {
namespace {

// Returns the component of each tet: components are joined by whole faces.
std::vector<int> find_pieces(const Cage& cage) {
    UnionFind pieces(cage.tets.size());
    std::map<std::array<int, 3>, int> faces;
    for (size_t e = 0; e < cage.tets.size(); e++)
        for (size_t left_out = 0; left_out < 4; left_out++) {
            std::array<int, 3> face;
            for (size_t k = 0; k < 3; k++) face[k] = cage.tets[e][k + (k >= left_out)];
            std::sort(face.begin(), face.end());
            const auto [entry, is_new] = faces.try_emplace(face, int(e));
            if (!is_new) pieces.join(entry->second, int(e));
        }
    std::vector<int> piece(cage.tets.size());
    for (size_t e = 0; e < piece.size(); e++) piece[e] = pieces.find(int(e));
    return piece;
}

// Returns whether points span a triangle that fixes a body of that size.
bool span_triangle(const std::vector<Vec3>& points, double size) {
    if (points.size() < 3) return false;
    Vec3 far = points[0];
    for (const Vec3& p : points)
        if ((p - points[0]).squaredNorm() > (far - points[0]).squaredNorm()) far = p;
    const Vec3 line = far - points[0];
    constexpr double LEAST = 0.003;  // width of the triangle over the size of the body [-]
    return std::any_of(points.begin(), points.end(), [&](const Vec3& p) {
        return line.cross(p - points[0]).norm() > LEAST * size * line.norm() && line.norm() > LEAST * size;
    });
}

}  // namespace

std::vector<char> find_firm_tets(const Cage& cage, const std::vector<uint8_t>& held) {
    const std::vector<int> piece = find_pieces(cage);
    std::vector<std::vector<int>> piece_nodes(cage.tets.size());
    for (size_t e = 0; e < piece.size(); e++)
        for (int corner : cage.tets[e]) piece_nodes[size_t(piece[e])].push_back(corner);
    for (std::vector<int>& nodes : piece_nodes) {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    // Fixed components fix their neighbours, until nothing changes.
    std::vector<uint8_t> fixed = held;
    std::vector<char> firm(piece_nodes.size(), 0);
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t p = 0; p < piece_nodes.size(); p++) {
            if (firm[p] || piece_nodes[p].empty()) continue;
            Eigen::AlignedBox3d box;
            std::vector<Vec3> points;
            for (int node : piece_nodes[p]) {
                box.extend(cage.nodes[size_t(node)]);
                if (fixed[size_t(node)]) points.push_back(cage.nodes[size_t(node)]);
            }
            if (!span_triangle(points, box.diagonal().norm())) continue;
            firm[p] = 1;
            for (int node : piece_nodes[p]) fixed[size_t(node)] = 1;
            changed = true;
        }
    }
    std::vector<char> firm_tets(piece.size());
    for (size_t e = 0; e < piece.size(); e++) firm_tets[e] = firm[size_t(piece[e])];
    return firm_tets;
}

std::vector<uint8_t> find_held_nodes(const Cage& cage, const std::vector<uint8_t>& root) {
    std::vector<uint8_t> held(cage.nodes.size(), 1);
    const std::vector<char> firm = find_firm_tets(cage, root);
    for (size_t e = 0; e < firm.size(); e++)
        if (firm[e])
            for (int corner : cage.tets[e]) held[size_t(corner)] = root[size_t(corner)];
    return held;
}

}  // namespace frond
