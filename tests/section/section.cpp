// Sections: area, second moments and torsion constant of outlines compared with closed forms, and the effect of the
// material.
#include "section/section.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "io/import.hpp"
#include "support/materials.hpp"

namespace frond {
namespace section_tests {

constexpr double LENGTH = 1;  // length of the bodies along +y [m]

// A surface, its one organ, and its chain and sections.
struct Sample {
    Surface surface;
    Topology topology;
    std::vector<Organ> organs;
    Chain chain;
    std::vector<Section> sections;

    Sample(Surface given, const char* kind, const Material& material, double height = 0.1) : surface(std::move(given)) {
        for (Part& part : surface.parts) part.organ = 0;
        topology = make_topology(surface);
        organs = {{"it", kind, material}};
        chain = make_chain(surface, topology, organs, {height, 0});
        sections = measure_sections(surface, topology, organs, chain);
    }
    // Returns the sections away from the ends, whose capsules extend into the caps.
    std::vector<Section> inner() const {
        EXPECT_GT(sections.size(), 6u);
        return {sections.begin() + 2, sections.end() - 1};
    }
};

Material wood(double thickness = 1e-3) {
    return plain_material(800, 1e9, 0.25, thickness);
}

// Returns a prism over a polygon in the xz-plane, in rings 0.05 m apart; `closed` joins the last corner with the first
// and closes the ends by fans.
Surface prism(const std::vector<Vec3>& corners, bool closed) {
    constexpr int RINGS = 20;
    Surface surface;
    const int n = int(corners.size()), sides = closed ? n : n - 1;
    for (int ring = 0; ring <= RINGS; ring++)
        for (const Vec3& corner : corners) surface.positions.push_back(corner + Vec3(0, ring * LENGTH / RINGS, 0));
    const auto at = [n](int ring, int k) { return ring * n + k % n; };
    for (int ring = 0; ring < RINGS; ring++)
        for (int k = 0; k < sides; k++) {
            surface.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
            surface.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
        }
    for (int k = 1; closed && k + 1 < n; k++) {
        surface.triangles.push_back({at(0, 0), at(0, k), at(0, k + 1)});
        surface.triangles.push_back({at(RINGS, 0), at(RINGS, k + 1), at(RINGS, k)});
    }
    Part part;
    part.name = "it";
    part.triangle_count = int(surface.triangles.size());
    surface.parts.push_back(part);
    return surface;
}

std::vector<Vec3> rectangle(double width, double depth) {
    const double x = width / 2, z = depth / 2;
    return {{x, 0, z}, {x, 0, 0}, {x, 0, -z}, {0, 0, -z}, {-x, 0, -z}, {-x, 0, 0}, {-x, 0, z}, {0, 0, z}};
}

Surface stem(double radius_begin, double radius_end) {
    const frond_stem it = {-1, {0, 0, 0}, {0, LENGTH, 0}, radius_begin, radius_end};
    return surface_from_stems(&it, 1);
}

// ---- closed forms -------------------------------------------------------------------------------------------------

TEST(Torsion, IsExactForEllipsesAndRectangles) {
    for (double aspect : {1.0, 1.3, 2.0, 5.0, 50.0}) {
        const double a = 0.01, b = a * aspect, area = M_PI * a * b;
        const double exact = M_PI * std::pow(a * b, 3) / (a * a + b * b);
        EXPECT_NEAR(torsion_constant(area, area * a * a / 4, area * b * b / 4) / exact, 1, 1e-9) << aspect;
    }
    // Timoshenko, Goodier, Theory of Elasticity, article 109: J = k w t^3.
    const std::pair<double, double> published[] = {{1, 0.1406}, {1.5, 0.196}, {2, 0.229}, {4, 0.281}, {10, 0.312}};
    for (const auto& [aspect, k] : published) {
        const double t = 0.01, w = aspect * t, area = w * t;
        EXPECT_NEAR(strip_torsion_constant(w, t) / (w * t * t * t), k, 6e-4) << aspect;
        EXPECT_NEAR(torsion_constant(area, area * t * t / 12, area * w * w / 12), strip_torsion_constant(w, t),
                    1e-6 * strip_torsion_constant(w, t))
            << aspect;
        EXPECT_EQ(strip_torsion_constant(w, t), strip_torsion_constant(t, w));
    }
    EXPECT_NEAR(strip_torsion_constant(1, 1e-3) / (1e-9 / 3), 1, 1e-3);
}

TEST(Torsion, IsNearForAnEquilateralTriangle) {
    const double area = std::sqrt(3) / 4, inertia = std::sqrt(3) / 96;
    EXPECT_NEAR(torsion_constant(area, inertia, inertia) / (std::sqrt(3) / 80), 1, 0.06);
}

// The section of a ten-sided tube from stems equals that of the round stem within 0.1 %.
TEST(Section, OfAStemIsTheSolidCircle) {
    const double r = 0.01, area = M_PI * r * r, inertia = area * r * r / 4;
    const Sample sample(stem(r, r), "stem", wood());
    for (const Section& section : sample.inner()) {
        EXPECT_NEAR(section.area / area, 1, 2e-3);
        EXPECT_NEAR(section.inertia_thin / inertia, 1, 2e-3);
        EXPECT_NEAR(section.inertia_wide / inertia, 1, 2e-3);
        EXPECT_NEAR(section.torsion / (2 * inertia), 1, 2e-3);
        EXPECT_NEAR(section.thickness / (2 * r), 1, 2e-3);
        EXPECT_NEAR(section.width / (2 * r), 1, 2e-3);
        EXPECT_NEAR(section.stretching() / (1e9 * area), 1, 2e-3);
        EXPECT_NEAR(section.bending_thin() / (1e9 * inertia), 1, 2e-3);
        EXPECT_NEAR(section.twisting() / (0.4e9 * 2 * inertia), 1, 2e-3);  // G = E / 2(1 + nu)
        EXPECT_NEAR(section.mass() / (800 * area), 1, 2e-3);
        EXPECT_NEAR(section.rotary_inertia().x() / (800 * 2 * inertia), 1, 2e-3);
        EXPECT_NEAR(section.axis.y(), 1, 1e-6);
    }
}

TEST(Section, OfATaperIsThatOfItsPlace) {
    const double r0 = 0.02, r1 = 0.008;
    const Sample sample(stem(r0, r1), "stem", wood());
    for (size_t i = 2; i + 1 < sample.sections.size(); i++) {
        const double begin = sample.chain.nodes[size_t(sample.chain.nodes[i].parent)].position.y();
        const double end = sample.chain.nodes[i].position.y();
        // The mean of 1 / r^4 over the capsule.
        const auto radius = [&](double y) { return r0 + (r1 - r0) * y / LENGTH; };
        const double mean =
            (std::pow(radius(end), -3) - std::pow(radius(begin), -3)) / (3 * (radius(begin) - radius(end)));
        EXPECT_NEAR(sample.sections[i].bending_thin() / 1e9 * mean / (M_PI / 4), 1, 3e-3) << i;
        EXPECT_NEAR(sample.sections[i].taper, (radius(end) - radius(begin)) / (radius(end) + radius(begin)), 1e-3) << i;
    }
}

TEST(Section, OfAPrismIsItsRectangle) {
    const Vec3 tilt = Eigen::AngleAxisd(0.4, Vec3::UnitY()) * Vec3::UnitZ();
    for (const auto& [width, depth] : {std::pair{0.02, 0.02}, {0.03, 0.02}, {0.06, 0.01}}) {
        std::vector<Vec3> corners = rectangle(width, depth);
        for (Vec3& corner : corners) corner = Eigen::AngleAxisd(0.4, Vec3::UnitY()) * corner;
        const double area = width * depth, thin = area * depth * depth / 12, wide = area * width * width / 12;
        const Sample sample(prism(corners, true), "stem", wood());
        for (const Section& section : sample.inner()) {
            EXPECT_NEAR(section.area / area, 1, 1e-4);
            EXPECT_NEAR(section.inertia_thin / thin, 1, 1e-4);
            EXPECT_NEAR(section.inertia_wide / wide, 1, 1e-4);
            EXPECT_NEAR(section.torsion / strip_torsion_constant(width, depth), 1, 1e-3);
            EXPECT_NEAR(section.thickness / depth, 1, 1e-3);
            EXPECT_NEAR(section.width / width, 1, 1e-3);
            EXPECT_NEAR(section.thin.dot(section.axis), 0, 1e-9);
            EXPECT_NEAR(section.wide().norm(), 1, 1e-9);
            if (width > depth) {
                EXPECT_NEAR(std::abs(section.thin.dot(tilt)), 1, 1e-4);
            }
            // Bending towards the thin side rotates the section about its wide axis.
            EXPECT_NEAR(section.rotary_inertia().z() / (800 * thin), 1, 1e-4);
            EXPECT_NEAR(section.rotary_inertia().y() / (800 * wide), 1, 1e-4);
        }
    }
}

// Returns the corners of a polygon like a circle, about a place in the xz-plane.
std::vector<Vec3> circle(double radius, double x, double z) {
    constexpr int SIDES = 12;
    std::vector<Vec3> corners;
    for (int k = 0; k < SIDES; k++) {
        const double angle = 2 * M_PI * k / SIDES;
        corners.push_back({x + radius * std::sin(angle), 0, z + radius * std::cos(angle)});
    }
    return corners;
}

// Appends a surface, pressed to a length along y from a height on, to the same part.
void append(const Surface& other, double from, double length, Surface& surface) {
    const int first = int(surface.positions.size());
    for (const Vec3& place : other.positions)
        surface.positions.push_back({place.x(), from + length * place.y() / LENGTH, place.z()});
    for (const Triangle& triangle : other.triangles)
        surface.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
    surface.parts[0].triangle_count = int(surface.triangles.size());
}

// Twigs too short for capsules of their own are beams beside the trunk: no ring goes around all of them, and what lies
// within the trunk or is drawn twice is there once.
TEST(Section, OfATrunkWithTwigsBesideItIsTheSum) {
    constexpr int TWIGS = 60;
    constexpr double R = 0.01, TWIG = 0.003, LONG = 0.03;
    const double area = 12 * std::sin(M_PI / 12) * std::cos(M_PI / 12), inertia = area * (2 + std::cos(M_PI / 6)) / 12;
    for (const double away : {0.03, 0.002}) {
        Surface surface = prism(circle(R, 0, 0), true);
        for (int k = 0; k < TWIGS; k++) {
            const double angle = 2.4 * k, from = LENGTH * (0.2 + 0.5 * k / TWIGS);
            const Surface twig = prism(circle(TWIG, away * std::cos(angle), away * std::sin(angle)), true);
            for (int times = 0; times < 2; times++) append(twig, from, LONG, surface);
        }
        const double beside = away > R ? area * TWIG * TWIG * TWIGS * LONG : 0, trunk = area * R * R;
        const Sample sample(std::move(surface), "stem", wood());
        SCOPED_TRACE(testing::Message() << "away " << away);
        double volume = 0, length = 0;
        for (const Section& section : sample.inner()) {
            volume += section.area * section.length;
            length += section.length;
            const double bending = section.inertia_thin / (inertia * std::pow(R, 4));
            EXPECT_GT(bending, 0.999);
            EXPECT_LT(bending, away > R ? 1.06 : 1.001);
            EXPECT_NEAR(section.torsion / (2 * inertia * std::pow(R, 4)), bending, 0.02);
        }
        EXPECT_NEAR(length, LENGTH - 0.25, 0.06);
        EXPECT_NEAR(volume / (trunk * length + beside), 1, away > R ? 0.07 : 1e-3);
    }
}

// The other face of a tube is a hole, where one capsule holds both.
TEST(Section, OfADrawnTubeIsItsWall) {
    constexpr double R = 0.02, HOLE = 0.012;
    Surface surface = prism(circle(R, 0, 0), true);
    Surface inner = prism(circle(HOLE, 0, 0), true);
    for (Triangle& triangle : inner.triangles) std::swap(triangle[0], triangle[1]);
    append(inner, 0, LENGTH, surface);
    // The rims join both faces instead of closing each.
    constexpr int SIDES = 12, ENDS = 2 * (SIDES - 2), RINGS = 20;
    const int half = int(surface.triangles.size()) / 2, first = int(surface.positions.size()) / 2;
    surface.triangles.erase(surface.triangles.end() - ENDS, surface.triangles.end());
    surface.triangles.erase(surface.triangles.begin() + half - ENDS, surface.triangles.begin() + half);
    for (int ring : {0, RINGS})
        for (int k = 0; k < SIDES; k++) {
            const int a = ring * SIDES + k, b = ring * SIDES + (k + 1) % SIDES;
            surface.triangles.push_back({a, b, b + first});
            surface.triangles.push_back({a, b + first, a + first});
        }
    surface.parts[0].triangle_count = int(surface.triangles.size());
    const double area = 12 * std::sin(M_PI / 12) * std::cos(M_PI / 12), inertia = area * (2 + std::cos(M_PI / 6)) / 12;
    const Sample sample(std::move(surface), "stem", wood(), 2 * LENGTH);
    ASSERT_EQ(sample.sections.size(), 2u);
    EXPECT_NEAR(sample.sections[1].area / (area * (R * R - HOLE * HOLE)), 1, 1e-3);
    EXPECT_NEAR(sample.sections[1].inertia_thin / (inertia * (std::pow(R, 4) - std::pow(HOLE, 4))), 1, 1e-3);
}

TEST(Section, DoesNotCareWhichWayTheTrianglesRun) {
    Surface inside_out = prism(rectangle(0.03, 0.02), true);
    for (Triangle& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
    const Sample sample(std::move(inside_out), "stem", wood());
    for (const Section& section : sample.inner()) EXPECT_NEAR(section.area / 6e-4, 1, 1e-4);
}

// Nor whether all run the same way.
TEST(Section, DoesNotCareWhetherTrianglesRunAlike) {
    for (const char* kind : {"stem", "blade"}) {
        Surface mixed = prism(rectangle(0.04, 0.004), true);
        for (size_t t = 0; t < mixed.triangles.size(); t += 3) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
        const Sample sample(std::move(mixed), kind, wood());
        for (const Section& section : sample.inner()) {
            EXPECT_NEAR(section.area / 1.6e-4, 1, 1e-3) << kind;
            EXPECT_NEAR(section.inertia_thin / (1.6e-4 * 1.6e-5 / 12), 1, 1e-3) << kind;
        }
    }
}

// Triangles that share no points: the outline is unknown, but the spread of the surface still gives the stem.
TEST(Section, OfASoupIsNearTheStem) {
    const double r = 0.01, area = M_PI * r * r, inertia = area * r * r / 4;
    Surface soup = stem(r, r);
    for (size_t t = 0; t < soup.triangles.size(); t += 2) {
        const Vec3 out = 1e-4 * Vec3(soup.positions[size_t(soup.triangles[t][0])].x(), 0, 0);
        for (int& corner : soup.triangles[t]) {
            soup.positions.push_back(soup.positions[size_t(corner)] + out);
            corner = int(soup.positions.size()) - 1;
        }
        if (t % 3 == 0) std::swap(soup.triangles[t][0], soup.triangles[t][1]);
    }
    const Sample sample(std::move(soup), "stem", wood());
    for (const Section& section : sample.inner()) {
        EXPECT_NEAR(section.area / area, 1, 0.05);
        EXPECT_NEAR(section.inertia_thin / inertia, 1, 0.12);
        EXPECT_NEAR(section.torsion / (2 * inertia), 1, 0.12);
    }
}

TEST(Section, OfAStripHasItsOwnWidthAndThickness) {
    const double w = 0.04, t = 5e-4, area = w * t;
    for (bool doubled : {false, true}) {
        // With two faces 0.01 mm apart it is drawn twice, but is no thicker than its material.
        const Surface surface =
            doubled ? prism(rectangle(w, 1e-5), true) : prism({{-w / 2, 0, 0}, {0, 0, 0}, {w / 2, 0, 0}}, false);
        Material material = wood(t);
        for (const Section& section : Sample(surface, "blade", material).inner()) {
            EXPECT_NEAR(section.inertia_thin / (area * t * t / 12), 1, 0.05) << doubled;
            EXPECT_NEAR(section.torsion / (w * t * t * t / 3), 1, 0.05) << doubled;
        }
        material.midrib = 0.05;
        const Sample sample(surface, "blade", material);
        for (const Section& section : sample.inner()) {
            EXPECT_NEAR(section.thickness, t, 1e-12) << doubled;
            EXPECT_NEAR(section.width / w, 1, 0.01) << doubled;
            EXPECT_NEAR(section.area / area, 1, 0.01) << doubled;
            EXPECT_NEAR(section.inertia_wide / (area * w * w / 12), 1, 0.03) << doubled;
            EXPECT_NEAR(std::abs(section.thin.z()), 1, 1e-3) << doubled;
            // It is never softer than its round midrib.
            const double rib = std::pow(w / 40, 4) * M_PI / 4;
            EXPECT_NEAR(section.inertia_thin / rib, 1, 0.05) << doubled;
            EXPECT_NEAR(section.torsion / (w * t * t * t / 3 + 2 * rib), 1, 0.05) << doubled;
        }
    }
}

// A rib that is drawn as a tube of its own along a blade is one beam with it: moduli count, and so do the places.
TEST(Section, OfABladeWithItsRibIsTheSumOfBoth) {
    const double w = 0.06, t = 4e-4, r = 2e-3;
    constexpr int SIDES = 24;
    for (const double below : {0.0, r}) {
        Surface surface = prism({{-w / 2, 0, 0}, {0, 0, 0}, {w / 2, 0, 0}}, false);
        std::vector<Vec3> circle;
        for (int k = 0; k < SIDES; k++) {
            const double angle = 2 * M_PI * k / SIDES;
            circle.push_back({r * std::sin(angle), 0, r * std::cos(angle) - below});
        }
        const Surface tube = prism(circle, true);
        const int first = int(surface.positions.size());
        Part part = surface.parts.front();
        part.first_triangle = part.triangle_count;
        part.triangle_count = int(tube.triangles.size());
        surface.parts.push_back(part);
        for (const Vec3& place : tube.positions) surface.positions.push_back(place);
        for (const Triangle& triangle : tube.triangles)
            surface.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
        std::vector<Organ> organs = {{"leaf", "blade", wood(t)}, {"rib", "midrib", wood()}};
        organs[0].material.midrib = 0.05;
        organs[1].material.young *= 3;
        organs[1].material.density *= 2;
        surface.parts[0].organ = 0;
        surface.parts[1].organ = 1;
        const Topology topology = make_topology(surface);
        const Chain chain = make_chain(surface, topology, organs, {0.1, 0});
        const std::vector<Section> sections = measure_sections(surface, topology, organs, chain);
        EXPECT_EQ(chain.root_count(), 1);
        EXPECT_NEAR(chain.length(), LENGTH, 0.05);
        SCOPED_TRACE(testing::Message() << "below " << below);
        const double sheet = w * t, rib = M_PI * r * r, inertia = rib * r * r / 4;
        const double apart = sheet * 3 * rib / (sheet + 3 * rib) * below * below;
        for (size_t i = 2; i + 1 < sections.size(); i++) {
            EXPECT_EQ(chain.nodes[i].organ, 0);
            EXPECT_NEAR(sections[i].stretching() / (1e9 * (sheet + 3 * rib)), 1, 0.02);
            EXPECT_NEAR(sections[i].bending_thin() / (1e9 * (sheet * t * t / 12 + 3 * inertia + apart)), 1, 0.03);
            EXPECT_NEAR(sections[i].bending_wide() / (1e9 * (sheet * w * w / 12 + 3 * inertia)), 1, 0.03);
            EXPECT_NEAR(sections[i].twisting() / (0.4e9 * (w * t * t * t / 3 + 3 * 2 * inertia)), 1, 0.03);
            EXPECT_NEAR(sections[i].mass() / (800 * (sheet + 2 * rib)), 1, 0.02);
        }
    }
}

// A leaf drawn with two faces is the box that they bound, whatever its kind.
TEST(Section, OfAThickLeafIsTheBoxThatIsDrawn) {
    const double w = 0.04;
    for (double t : {4e-3, 8e-3}) {
        const double area = w * t;
        const Sample sample(prism(rectangle(w, t), true), "blade", wood(5e-4));
        for (const Section& section : sample.inner()) {
            EXPECT_NEAR(section.thickness / t, 1, 1e-3);
            EXPECT_NEAR(section.area / area, 1, 0.01);
            EXPECT_NEAR(section.inertia_thin / (area * t * t / 12), 1, 0.02);
            EXPECT_NEAR(section.inertia_wide / (area * w * w / 12), 1, 0.03);
            EXPECT_NEAR(section.torsion / strip_torsion_constant(w, t), 1, 0.02);
        }
    }
}

// Faces that bow together: the sheet between them stiffens as the one-faced sheet in their middle does.
TEST(Section, OfABowedLeafIsThatOfItsMiddleSurface) {
    const double w = 0.04, t = 1e-3, radius = 0.03;
    constexpr int SIDES = 16;
    const auto arc = [&](double r, int k) {
        const double angle = w / radius * (double(k) / SIDES - 0.5);
        return Vec3(r * std::sin(angle), 0, r * std::cos(angle));
    };
    std::vector<Vec3> middle, faces;
    for (int k = 0; k <= SIDES; k++) middle.push_back(arc(radius, k));
    for (int k = 0; k <= SIDES; k++) faces.push_back(arc(radius + t / 2, k));
    for (int k = SIDES; k >= 0; k--) faces.push_back(arc(radius - t / 2, k));
    const std::vector<Section> one = Sample(prism(middle, false), "blade", wood(t)).inner();
    const std::vector<Section> two = Sample(prism(faces, true), "blade", wood(5e-4)).inner();
    ASSERT_EQ(one.size(), two.size());
    for (size_t i = 0; i < one.size(); i++) {
        EXPECT_NEAR(two[i].thickness / t, 1, 0.01);
        EXPECT_NEAR(two[i].area / one[i].area, 1, 0.02);
        EXPECT_NEAR(two[i].inertia_thin / one[i].inertia_thin, 1, 0.05);
        EXPECT_NEAR(two[i].inertia_wide / one[i].inertia_wide, 1, 0.05);
    }
}

// ---- material -----------------------------------------------------------------------------------------------------

TEST(Section, OfATubeIsItsWall) {
    const double r = 0.01, h = 0.8, area = M_PI * r * r * (1 - h * h);
    const double inertia = M_PI * std::pow(r, 4) * (1 - std::pow(h, 4)) / 4;
    Material material = wood();
    material.hollow = h;
    const Sample tube(stem(r, r), "stem", material);
    for (const Section& section : tube.inner()) {
        EXPECT_NEAR(section.area / area, 1, 2e-3);
        EXPECT_NEAR(section.inertia_thin / inertia, 1, 2e-3);
        EXPECT_NEAR(section.torsion / (2 * inertia), 1, 2e-3);
        EXPECT_NEAR(section.mass() / (800 * area), 1, 2e-3);
        EXPECT_NEAR(section.thickness / (2 * r), 1, 2e-3);  // outer thickness
    }
    EXPECT_NEAR(hole_share(tube.organs[0]), h * h, 1e-15);
    EXPECT_EQ(hole_share({"leaf", "blade", material}), 0);
}

TEST(Section, TwistsAsItsMaterialSays) {
    for (double ratio : {0.5, 4.3, 100.0}) {
        for (double hollow : {0.0, 0.9}) {
            Material material = wood();
            material.twist_to_bend = ratio;
            material.hollow = hollow;
            const Sample sample(prism(rectangle(0.03, 0.02), true), "petiole", material);
            for (const Section& section : sample.inner())
                EXPECT_NEAR(0.5 * (section.bending_thin() + section.bending_wide()) / section.twisting(), ratio,
                            1e-9 * ratio);
        }
    }
    const Sample isotropic(stem(0.01, 0.01), "petiole", wood());
    for (const Section& section : isotropic.inner())
        EXPECT_NEAR(section.bending_thin() / section.twisting(), 1.25, 5e-3);  // 1 + nu
}

}  // namespace section_tests

}  // namespace frond
