// Surface, organs and chain -> sections. Where planes across a capsule cut one closed outline, that is the section.
// Elsewhere (open sheets, soups, forks) the section follows from the spread of the surface across the axis. The
// material then determines the hole, the stiffness and the mass.
#include "section/section.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"
#include "core/decompose.hpp"
#include "core/elementary.hpp"
#include "section/section_parts.hpp"

namespace frond {

namespace {

std::vector<CapsuleFrame> make_frames(const Chain& chain) {
    std::vector<CapsuleFrame> frames(chain.nodes.size());
    for (size_t i = 0; i < frames.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        CapsuleFrame& frame = frames[i];
        frame.begin = node.parent >= 0 ? chain.nodes[size_t(node.parent)].position : node.position;
        frame.length = (node.position - frame.begin).norm();
        const bool stands = frame.length > 1e-9 * (1 + node.radius);
        frame.axis = stands ? Vec3((node.position - frame.begin) / frame.length) : Vec3(Vec3::UnitY());
        if (!stands) frame.length = std::max(node.radius, 1e-6);
        frame.across = frame.axis.unitOrthogonal();
        frame.other = frame.axis.cross(frame.across);
    }
    return frames;
}

void take_outline(const Outline& outline, Section& section) {
    section.thin = outline.thin;
    section.area = outline.area;
    section.inertia_thin = outline.inertia_thin;
    section.inertia_wide = outline.inertia_wide;
    section.taper = outline.taper;
}

// A blade may have a round midrib that its sheet does not show.
void add_rib(double width, double midrib, Section& section) {
    const double rib = width * midrib / 2;
    section.inertia_thin = std::max(section.inertia_thin, PI * frond::pow(rib, 4) / 4);
    section.inertia_wide = std::max(section.inertia_wide, section.inertia_thin);
}

// Fills a sheet of width w and thickness t: area w t, inertia from the spread of its middle surface and its own
// thickness.
void fill_sheet(const Spread& spread, double width, const Material& material, Section& section) {
    const double thickness = material.thickness;
    const double own = thickness * thickness / 12;
    section.area = width * thickness;
    section.inertia_thin = section.area * (spread.small + own);
    section.inertia_wide = section.area * (spread.large + own);
    add_rib(width, material.midrib, section);
}

// Fills a solid from the ring that its surface forms: with variances a and b it encloses 2 pi sqrt(a b), and its
// inertia is area times variance over two (exact for a circle). It is never less than that of a sheet with the same
// surface.
void fill_ring(const Spread& spread, double width, double thickness, Section& section) {
    const double own = thickness * thickness / 12, sheet = width * thickness;
    const double solid = 2 * PI * std::sqrt(spread.small * spread.large);
    section.area = std::max(sheet, solid);
    section.inertia_thin = std::max(sheet * (spread.small + own), solid * spread.small / 2);
    section.inertia_wide = std::max(sheet * (spread.large + own), solid * spread.large / 2);
}

// Two faces bound a sheet, unless they are so close that they are its middle surface, drawn twice.
bool is_bounded(const Organ& organ, const Outline& outline) {
    return outline.found && outline.doubled && outline.gap > 0.5 * organ.material.thickness;
}

// Returns the thickness of each sheet that is bounded by two faces for a good part of its length, else 0 [m].
std::vector<double> measure_gaps(const std::vector<Organ>& organs, const Chain& chain,
                                 const std::vector<Outline>& outlines) {
    constexpr double GOOD_PART = 1.0 / 3;  // of a sheet's capsules
    std::vector<std::vector<double>> gaps(organs.size());
    std::vector<int> capsules(organs.size(), 0);
    for (size_t i = 0; i < chain.nodes.size(); i++) {
        const int organ = chain.nodes[i].organ;
        if (chain.nodes[i].parent < 0 || organ < 0 || !is_sheet(organs[size_t(organ)])) continue;
        capsules[size_t(organ)]++;
        if (is_bounded(organs[size_t(organ)], outlines[i])) gaps[size_t(organ)].push_back(outlines[i].gap);
    }
    std::vector<double> middle(organs.size(), 0.0);
    for (size_t o = 0; o < organs.size(); o++) {
        if (gaps[o].empty() || double(gaps[o].size()) < GOOD_PART * capsules[o]) continue;
        const auto half = gaps[o].begin() + long(gaps[o].size() / 2);
        std::nth_element(gaps[o].begin(), half, gaps[o].end());
        middle[o] = *half;
    }
    return middle;
}

// Takes the section of another capsule, rotated to lie across the own axis.
void take_section(const Section& from, Section& section) {
    const Vec3 across = from.thin - from.thin.dot(section.axis) * section.axis;
    section.thin = across.norm() > 0.1 ? Vec3(across.normalized()) : Vec3(section.axis.unitOrthogonal());
    section.area = from.area;
    section.inertia_thin = from.inertia_thin;
    section.inertia_wide = from.inertia_wide;
}

// Fills area and second moments of a capsule's outline, without its hole. Returns whether they are exact.
bool fill_outline(const ChainNode& node, const Organ& organ, double gap, const Spread& spread, const Outline& outline,
                  const std::vector<Section>& before, Section& section) {
    const double drawn = spread.area / section.length;
    section.thickness = organ.material.thickness;
    if (is_sheet(organ) && spread.area > 0) {
        const bool bounded = is_bounded(organ, outline);
        if (!bounded && gap > 0) {
            // Elsewhere in this organ two faces bound it; here other organs are part of the outline.
            Material thick = organ.material;
            thick.thickness = section.thickness = gap;
            section.thin = spread.thin;
            fill_sheet(spread, drawn / 2, thick, section);
        } else if (bounded) {
            section.thickness = outline.gap;
            take_outline(outline, section);
            add_rib(section.area / section.thickness, organ.material.midrib, section);
        } else {
            section.thin = spread.thin;
            fill_sheet(spread, outline.doubled ? drawn / 2 : drawn, organ.material, section);
        }
        return bounded;
    }
    if (!is_sheet(organ) && outline.found) {
        take_outline(outline, section);
        return true;
    }
    if (spread.area > 0) {
        section.thin = spread.thin;
        fill_ring(spread, drawn, organ.material.thickness, section);
        return false;
    }
    if (node.parent >= 0) {
        // No surface is nearest to it.
        take_section(before[size_t(node.parent)], section);
        return false;
    }
    section.thin = section.axis.unitOrthogonal();
    section.area = PI * node.radius * node.radius;
    section.inertia_thin = section.inertia_wide = section.area * node.radius * node.radius / 4;
    return false;
}

// Petioles are drawn to a point where their leaf begins, but go on there as its midrib: as thick as before the point.
void continue_petioles(const Chain& chain, const std::vector<Organ>& organs, std::vector<char>& exact,
                       std::vector<Section>& sections) {
    constexpr double POINT = 0.25;  // area over that of the capsule before [-]
    std::vector<char> bears(sections.size(), 0);
    for (const ChainNode& node : chain.nodes)
        if (node.parent >= 0 && chain.nodes[size_t(node.parent)].organ != node.organ) bears[size_t(node.parent)] = 1;
    for (size_t i = 0; i < sections.size(); i++) {
        const ChainNode& node = chain.nodes[i];
        if (!bears[i] || node.parent < 0 || node.organ < 0 || organs[size_t(node.organ)].kind != "petiole") continue;
        const size_t before = size_t(node.parent);
        if (chain.nodes[before].organ != node.organ || sections[i].area >= POINT * sections[before].area) continue;
        take_section(sections[before], sections[i]);
        exact[i] = exact[before];
    }
}

// Returns the capsule in which each goes on within its organ, the straightest where it forks; -1 after a root, which
// has no capsule, and at an end.
std::vector<int> find_next(const Chain& chain, const std::vector<Section>& sections) {
    std::vector<int> next(sections.size(), -1);
    for (size_t i = 0; i < sections.size(); i++) {
        const int parent = chain.nodes[i].parent;
        if (parent < 0 || chain.nodes[size_t(parent)].parent < 0) continue;
        if (chain.nodes[size_t(parent)].organ != chain.nodes[i].organ) continue;
        const Vec3& axis = sections[size_t(parent)].axis;
        int& straightest = next[size_t(parent)];
        if (straightest < 0 || sections[i].axis.dot(axis) > sections[size_t(straightest)].axis.dot(axis))
            straightest = int(i);
    }
    return next;
}

// A surface of few triangles gives ragged sections: each that is not exact becomes the mean with those before and after
// it. A side branch is neither.
void smooth_sections(const Chain& chain, const std::vector<char>& exact, std::vector<Section>& sections) {
    constexpr int PASSES = 2;  // after which the mean is over five capsules
    const std::vector<int> next = find_next(chain, sections);
    for (int pass = 0; pass < PASSES; pass++) {
        std::vector<Section> sum = sections;
        std::vector<int> count(sections.size(), 1);
        const auto add = [&](size_t to, size_t from) {
            if (exact[to]) return;
            sum[to].area += sections[from].area;
            sum[to].inertia_thin += sections[from].inertia_thin;
            sum[to].inertia_wide += sections[from].inertia_wide;
            count[to]++;
        };
        for (size_t i = 0; i < chain.nodes.size(); i++) {
            const int parent = chain.nodes[i].parent;
            if (parent < 0 || next[size_t(parent)] != int(i)) continue;
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

// Sheets: a bowed strip twists as easily as a flat one, so only the round rib is added to the flat strip's constant.
void finish_section(const Organ& organ, Section& section) {
    const Material& material = organ.material;
    if (is_sheet(organ)) {
        section.width = section.area / section.thickness;
        const double rib = PI * frond::pow(section.width * material.midrib / 2, 4) / 2;
        section.torsion = strip_torsion_constant(section.width, section.thickness) + rib;
    } else {
        // An ellipse of thickness t has I = A t^2 / 16, a rectangle A t^2 / 12.
        const double shape = 16 - 4 * squareness(section.area, section.inertia_thin, section.inertia_wide);
        section.thickness = std::sqrt(shape * section.inertia_thin / section.area);
        section.width = std::sqrt(shape * section.inertia_wide / section.area);
        section.torsion = torsion_constant(section.area, section.inertia_thin, section.inertia_wide);
    }
    const double hole = hole_share(organ);
    section.area *= 1 - hole;
    for (double* moment : {&section.inertia_thin, &section.inertia_wide, &section.torsion}) *moment *= 1 - hole * hole;
    section.density = seen_share(organ) * material.density;
    if (section.thickness > solid_thickness(organ)) section.density *= solid_thickness(organ) / section.thickness;
    // A sheet with holes is as stiff as what is left of it.
    section.young = seen_share(organ) * material.young;
    section.shear = section.young / (2 * (1 + material.poisson));
    if (material.twist_to_bend > 0)
        section.shear = section.young * 0.5 * (section.inertia_thin + section.inertia_wide) /
                        (material.twist_to_bend * section.torsion);
}

// Adds a sheet's rib: one beam of two materials, whose section counts the rib's tissue by its modulus over the sheet's.
static void add_drawn_rib(const RibCut& rib, const Organ& organ, const CapsuleFrame& frame,
                          const Eigen::Vector2d& middle, Section& section) {
    const auto flat = [&](const Vec3& v) { return Eigen::Vector2d(v.dot(frame.across), v.dot(frame.other)); };
    const auto moments_of = [&](const Section& s) {
        const Eigen::Vector2d thin = flat(s.thin), wide = flat(s.wide());
        return Eigen::Matrix2d(s.inertia_thin * thin * thin.transpose() + s.inertia_wide * wide * wide.transpose());
    };
    const auto take_axes = [&](const Eigen::Matrix2d& moments, Section& s) {
        const SymmetricParts2 parts = symmetric_parts_2(moments);
        s.inertia_thin = parts.values[0];
        s.inertia_wide = parts.values[1];
        s.thin = (parts.vectors(0, 0) * frame.across + parts.vectors(1, 0) * frame.other).normalized();
    };
    Section own = {};
    own.axis = section.axis;
    own.length = section.length;
    own.area = rib.area;
    take_axes(rib.moments, own);
    finish_section(organ, own);
    const double by = own.young / section.young, area = section.area + by * own.area;
    const Eigen::Vector2d apart = rib.middle - middle;
    section.density = (section.mass() + own.mass()) / area;
    take_axes(
        moments_of(section) + by * moments_of(own) + section.area * by * own.area / area * apart * apart.transpose(),
        section);
    section.area = area;
    section.torsion += own.twisting() / section.shear;
}

double hole_share(const Organ& organ) {
    return is_sheet(organ) ? 0 : organ.material.hollow * organ.material.hollow;
}

double seen_share(const Organ& organ) {
    return is_sheet(organ) ? organ.opacity : 1;
}

std::vector<Section> measure_sections(const Surface& surface, const Topology& topology,
                                      const std::vector<Organ>& organs, const Chain& chain) {
    const std::vector<CapsuleFrame> frames = make_frames(chain);
    FROND_ASSERT(chain.vertex_node.size() == surface.positions.size());
    FROND_ASSERT(!organs.empty());
    FROND_ASSERT(frames.size() == chain.nodes.size());
    std::vector<char> hearts = find_hearts(chain);
    for (size_t i = 0; i < hearts.size(); i++)
        hearts[i] = hearts[i] && is_sheet(organs[size_t(std::max(chain.nodes[i].organ, 0))]);
    const std::vector<Spread> spreads = measure_spreads(surface, chain, frames, hearts);
    std::vector<Outline> outlines = cut_outlines(surface, topology, organs, chain, frames);
    // The outline of one leaf is not that of a heart.
    for (size_t i = 0; i < hearts.size(); i++)
        if (hearts[i]) outlines[i].found = outlines[i].doubled = false;
    const std::vector<double> gaps = measure_gaps(organs, chain, outlines);
    const std::vector<RibCut> ribs = cut_ribs(surface, topology, chain, frames);
    std::vector<Section> sections(chain.nodes.size());
    std::vector<char> exact(chain.nodes.size());
    // A blade with a rib of its own hides none.
    std::vector<Organ> bare = organs;
    for (int blade : chain.rib_of)
        if (blade >= 0) bare[size_t(blade)].material.midrib = 0;
    const auto organ_of = [&](size_t i) -> const Organ& { return bare[size_t(std::max(chain.nodes[i].organ, 0))]; };
    for (size_t i = 0; i < sections.size(); i++) {
        sections[i].axis = frames[i].axis;
        sections[i].length = frames[i].length;
        const double gap = chain.nodes[i].organ < 0 ? 0 : gaps[size_t(chain.nodes[i].organ)];
        exact[i] = fill_outline(chain.nodes[i], organ_of(i), gap, spreads[i], outlines[i], sections, sections[i]);
    }
    continue_petioles(chain, organs, exact, sections);
    smooth_sections(chain, exact, sections);
    for (size_t i = 0; i < sections.size(); i++) {
        finish_section(organ_of(i), sections[i]);
        if (ribs[i].organ >= 0)
            add_drawn_rib(ribs[i], organs[size_t(ribs[i].organ)], frames[i], spreads[i].middle, sections[i]);
    }
    carry_crowns(chain, organs, sections);
    hold_roots(chain, organs, sections);
    return sections;
}

}  // namespace frond
