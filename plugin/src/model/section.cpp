// Surface and chain -> sections. The spread of a capsule's surface across its axis is measured after the capsule's own
// bow along the axis is taken out, so that an arching leaf is not mistaken for a thick one.
#include "model/section.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace frond {
namespace {

// A share of surface that belongs to a capsule.
struct Patch {
    Vec3 position;
    double area;
};

// Triangles give a third of their area to the capsule of each corner, at four points, which have the same second
// moments as the triangle: the corners with 1/12 and the middle with 3/4 of it.
std::vector<std::vector<Patch>> collect_patches(const Surface& surface, const Chain& chain) {
    std::vector<std::vector<Patch>> patches(chain.nodes.size());
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            const Triangle& triangle = surface.triangles[size_t(t)];
            const Vec3& a = surface.positions[size_t(triangle[0])];
            const Vec3& b = surface.positions[size_t(triangle[1])];
            const Vec3& c = surface.positions[size_t(triangle[2])];
            const double third = (b - a).cross(c - a).norm() / 6;
            for (int corner : triangle) {
                const size_t node = size_t(chain.vertex_node[size_t(corner)]);
                if (chain.nodes[node].organ != part.organ) continue;
                std::vector<Patch>& list = patches[node];
                for (const Vec3& p : {a, b, c}) list.push_back({p, third / 12});
                list.push_back({(a + b + c) / 3, third * 3 / 4});
            }
        }
    return patches;
}

// Variances across the axis [m^2], small one first, with the direction of the small one.
struct Spread {
    double small, large;
    Vec3 thin;
};

Spread measure_spread(const std::vector<Patch>& patches, const Vec3& origin, const Vec3& axis, double length) {
    const Vec3 across = axis.unitOrthogonal(), other = axis.cross(across);
    // Offsets across the axis as a parabola along it, by least squares weighted with area.
    Mat3 normal = 1e-12 * Mat3::Identity();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    double total = 0;
    for (const Patch& patch : patches) {
        const Vec3 offset = patch.position - origin;
        const double s = offset.dot(axis) / length;
        const Vec3 powers(1, s, s * s);
        const Eigen::RowVector2d y(offset.dot(across), offset.dot(other));
        normal += patch.area * powers * powers.transpose();
        right += patch.area * powers * y;
        total += patch.area;
    }
    normal.diagonal().array() += 1e-9 * total;
    const Eigen::Matrix<double, 3, 2> bow = normal.ldlt().solve(right);
    // What is left is the spread of the section itself.
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const Patch& patch : patches) {
        const Vec3 offset = patch.position - origin;
        const double s = offset.dot(axis) / length;
        const Eigen::RowVector2d y =
            Eigen::RowVector2d(offset.dot(across), offset.dot(other)) - Vec3(1, s, s * s).transpose() * bow;
        covariance += patch.area / total * y.transpose() * y;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
    const Eigen::Vector2d direction = eigen.eigenvectors().col(0);
    return {std::max(eigen.eigenvalues()[0], 0.0), std::max(eigen.eigenvalues()[1], 0.0),
            (direction[0] * across + direction[1] * other).normalized()};
}

bool is_sheet(const Organ& organ) {
    return organ.kind == "blade" || organ.kind == "flower";
}

// A sheet of width w and thickness t: area w t, inertia from the spread of its middle surface and its own thickness. A
// solid ring of variances a and b encloses 2 pi sqrt(a b), and its inertia is area times variance over two (exact for a
// circle); it is never less than the sheet that would be drawn the same. A blade has a midrib that its sheet does not
// show: at least a round rib whose diameter is a twentieth of the width (maize: 4 mm of 80 mm).
void fill_section(const Spread& spread, double width, double thickness, bool sheet, Section& section) {
    const double own = thickness * thickness / 12;
    section.area = width * thickness;
    section.inertia_thin = section.area * (spread.small + own);
    section.inertia_wide = section.area * (spread.large + own);
    if (sheet) {
        const double rib = width / 40;
        section.inertia_thin = std::max(section.inertia_thin, M_PI * std::pow(rib, 4) / 4);
        section.inertia_wide = std::max(section.inertia_wide, section.inertia_thin);
        return;
    }
    const double solid = 2 * M_PI * std::sqrt(spread.small * spread.large);
    section.area = std::max(section.area, solid);
    section.inertia_thin = std::max(section.inertia_thin, solid * spread.small / 2);
    section.inertia_wide = std::max(section.inertia_wide, solid * spread.large / 2);
}

// A surface of few triangles gives ragged sections: each becomes the mean with its neighbours of the same organ.
void smooth_sections(const Chain& chain, std::vector<Section>& sections) {
    constexpr int PASSES = 2;
    for (int pass = 0; pass < PASSES; pass++) {
        std::vector<Section> sum = sections;
        std::vector<int> count(sections.size(), 1);
        const auto add = [&](size_t to, size_t from) {
            sum[to].area += sections[from].area;
            sum[to].inertia_thin += sections[from].inertia_thin;
            sum[to].inertia_wide += sections[from].inertia_wide;
            count[to]++;
        };
        for (size_t i = 0; i < chain.nodes.size(); i++) {
            const int parent = chain.nodes[i].parent;
            if (parent < 0 || chain.nodes[size_t(parent)].organ != chain.nodes[i].organ) continue;
            add(i, size_t(parent));
            add(size_t(parent), i);
        }
        for (size_t i = 0; i < sections.size(); i++) {
            sections[i].area = sum[i].area / count[i];
            sections[i].inertia_thin = sum[i].inertia_thin / count[i];
            sections[i].inertia_wide = sum[i].inertia_wide / count[i];
        }
    }
}

}  // namespace

std::vector<Section> measure_sections(const Surface& surface, const std::vector<Organ>& organs, const Chain& chain) {
    const std::vector<std::vector<Patch>> patches = collect_patches(surface, chain);
    std::vector<Section> sections(chain.nodes.size());
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        const Organ& organ = organs[size_t(std::max(node.organ, 0))];
        const Vec3 begin = node.parent >= 0 ? chain.nodes[size_t(node.parent)].position : node.position;
        Section& section = sections[i];
        section.length = (node.position - begin).norm();
        const bool stands = section.length > 1e-9 * (1 + node.radius);
        section.axis = stands ? Vec3((node.position - begin) / section.length) : Vec3(Vec3::UnitY());
        if (!stands) section.length = std::max(node.radius, 1e-6);
        double surface_area = 0;
        for (const Patch& patch : patches[i]) surface_area += patch.area;
        if (surface_area > 0) {
            const Spread spread = measure_spread(patches[i], begin, section.axis, section.length);
            section.thin = spread.thin;
            fill_section(spread, surface_area / section.length, organ.material.thickness, is_sheet(organ), section);
        } else if (node.parent >= 0) {
            // Nothing of the surface is nearest to it: as its parent is.
            const Section& parent = sections[size_t(node.parent)];
            section.thin = parent.thin;
            section.area = parent.area;
            section.inertia_thin = parent.inertia_thin;
            section.inertia_wide = parent.inertia_wide;
        } else {
            section.thin = section.axis.unitOrthogonal();
            section.area = M_PI * node.radius * node.radius;
            section.inertia_thin = section.inertia_wide = section.area * node.radius * node.radius / 4;
        }
    }
    smooth_sections(chain, sections);
    return sections;
}

}  // namespace frond
