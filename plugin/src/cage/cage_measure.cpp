// Measures a cage: angles, volumes, and how well the surface is attached to it.
#include <algorithm>
#include <limits>

#include "cage/cage_parts.hpp"
#include "core/elementary.hpp"

namespace frond {

bool dihedral_cosines(const std::array<Vec3, 4>& corners, double& of_smallest, double& of_largest) {
    // Outward normals of the faces opposite each corner, for a tet of positive volume.
    const Vec3 &a = corners[0], &b = corners[1], &c = corners[2], &d = corners[3];
    const std::array<Vec3, 4> normals = {(d - b).cross(c - b), (c - a).cross(d - a), (d - a).cross(b - a),
                                         (b - a).cross(c - a) * -1};
    std::array<double, 4> lengths;
    for (size_t k = 0; k < 4; ++k) {
        lengths[k] = normals[k].norm();
        if (!(lengths[k] > 0)) return false;
    }
    of_smallest = -1;
    of_largest = 1;
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = i + 1; k < 4; ++k) {
            const double cosine = -normals[i].dot(normals[k]) / (lengths[i] * lengths[k]);
            of_smallest = std::max(of_smallest, cosine);
            of_largest = std::min(of_largest, cosine);
        }
    return true;
}

CageReport measure_cage(const Surface& surface, const Cage& cage, const Embedding& embedding) {
    CageReport report{180, 0, std::numeric_limits<double>::infinity(), 0, 1, 0};
    for (const Tet& tet : cage.tets) {
        std::array<Vec3, 4> corners;
        for (size_t k = 0; k < 4; ++k) corners[k] = cage.nodes[size_t(tet[k])];
        const double volume = tet_volume(cage.nodes, tet);
        report.min_volume = std::min(report.min_volume, volume);
        report.volume += volume;
        double of_smallest = 1, of_largest = -1;
        dihedral_cosines(corners, of_smallest, of_largest);
        const double degrees = 180 / PI;
        report.min_dihedral = std::min(report.min_dihedral, degrees * frond::acos(std::clamp(of_smallest, -1.0, 1.0)));
        report.max_dihedral = std::max(report.max_dihedral, degrees * frond::acos(std::clamp(of_largest, -1.0, 1.0)));
    }
    if (cage.tets.empty()) report.min_volume = report.min_dihedral = 0;
    size_t contained = 0;
    const size_t bound = std::min(surface.positions.size(), embedding.tet.size());
    for (size_t v = 0; v < bound; ++v) {
        const Tet& tet = cage.tets[size_t(embedding.tet[v])];
        const auto& weights = embedding.weights[v];
        Vec3 place = Vec3::Zero();
        for (size_t k = 0; k < 4; ++k) place += weights[k] * cage.nodes[size_t(tet[k])];
        report.attachment_error = std::max(report.attachment_error, (place - surface.positions[v]).norm());
        contained += *std::min_element(weights.begin(), weights.end()) >= LOWEST_WEIGHT;
    }
    if (!surface.positions.empty()) report.contained = double(contained) / double(surface.positions.size());
    return report;
}

}  // namespace frond
