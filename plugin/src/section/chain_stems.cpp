// Stems -> chain. In: the caller's tree of tapered segments, and the placed surface made of it. Out: a chain whose
// capsules lie exactly on the axes, from the beginning of each segment to its end, and their sections, which are known.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/convert.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "section/section.hpp"

namespace frond {

namespace {

constexpr int USUAL_STEM_COUNT = 20;  // capsules along the longest path
constexpr int LEAST_COUNT = 2;        // capsules per segment
constexpr int MOST_COUNT = 2000;      // capsules along the longest path
constexpr double ONE_ROOT = 1e-3;     // of a stem's length: roots no farther apart are one

struct StemPiece {
    int parent;
    Vec3 begin, end;
    double radius_begin, radius_end, length;
    int organ;
    bool is_capsule;                // is cut only where others grow out
    const frond_stem_section* own;  // null: round, of its organ's material
    Vec3 thin;                      // placed direction of the own section's thickness at the begin, or zero
    double scale;                   // metres per unit of the own section
    std::vector<double> cuts;       // positions of chain nodes, 0 .. 1, ascending
    std::vector<int> nodes;         // chain nodes, one per cut
    double radius(double share) const { return radius_begin + share * (radius_end - radius_begin); }
    // Returns the place of an even cut. Pieces are shorter where a stem is thin, by their radius to the power of 2/3,
    // since waves are (by its root) and a thin piece's mass is lumped the more coarsely; where a stem narrows by half
    // at most, that is no matter.
    double even_cut(double share) const {
        constexpr double MILD = 2;  // radius over radius up to which pieces are of one length [-]
        if (std::max(radius_begin, radius_end) <= MILD * std::min(radius_begin, radius_end)) return share;
        const double a = frond::cbrt(radius_begin), b = frond::cbrt(radius_end), way = share * (b - a);
        return share * ((3 * a * (a + way) + way * way) / (a * (a + b) + b * b));
    }
    Vec3 place(double share) const { return begin + share * (end - begin); }
    double nearest(const Vec3& p) const {
        return std::min(std::max((p - begin).dot(end - begin) / (length * length), 0.0), 1.0);
    }
};

// Places the stems as the surface was, by the same rotation, scale and translation.
std::vector<StemPiece> place_stems(const frond_stem* stems, int count, const Surface& surface,
                                   const StemPlacement& placed, const std::vector<uint8_t>& are_capsules,
                                   const frond_stem_section* own) {
    std::vector<StemPiece> pieces;
    for (int i = 0; i < count; i++) {
        const frond_stem& stem = stems[i];
        StemPiece piece = {};
        piece.parent = stem.parent;
        piece.begin = placed.image(Vec3(stem.begin.x, stem.begin.y, stem.begin.z));
        piece.end = placed.image(Vec3(stem.end.x, stem.end.y, stem.end.z));
        piece.radius_begin = stem.radius_begin * surface.scale;
        piece.radius_end = stem.radius_end * surface.scale;
        piece.length = (piece.end - piece.begin).norm();
        piece.is_capsule = !are_capsules.empty() && are_capsules[size_t(i)];
        piece.own = own ? own + i : nullptr;
        piece.thin = own ? Vec3(placed.turn * to_vec(own[i].thin)) : Vec3(Vec3::Zero());
        piece.scale = surface.scale;
        pieces.push_back(piece);
    }
    for (const Part& part : surface.parts) pieces[size_t(std::stoi(part.name.substr(5)))].organ = part.organ;
    return pieces;
}

// Returns the length of the longest path from a root to a tip.
double longest_way(const std::vector<StemPiece>& pieces) {
    std::vector<double> reach(pieces.size());
    double longest = 0;
    for (size_t i = 0; i < pieces.size(); i++) {
        reach[i] = pieces[i].length + (pieces[i].parent >= 0 ? reach[size_t(pieces[i].parent)] : 0);
        longest = std::max(longest, reach[i]);
    }
    return longest;
}

// Cuts each segment evenly for its waves and where a child grows out; even cuts too close to the others are left out.
void cut_pieces(std::vector<StemPiece>& pieces, double height) {
    std::vector<std::vector<double>> joints(pieces.size());
    for (const StemPiece& piece : pieces)
        if (piece.parent >= 0)
            joints[size_t(piece.parent)].push_back(pieces[size_t(piece.parent)].nearest(piece.begin));
    for (size_t i = 0; i < pieces.size(); i++) {
        StemPiece& piece = pieces[i];
        const int count =
            piece.is_capsule ? 1 : std::clamp(int(std::lround(piece.length / height)), LEAST_COUNT, MOST_COUNT);
        std::vector<double> fixed = joints[i];
        fixed.insert(fixed.end(), {0.0, 1.0});
        std::sort(fixed.begin(), fixed.end());
        for (double cut : fixed)
            if (piece.cuts.empty() || cut - piece.cuts.back() > 1e-6) piece.cuts.push_back(cut);
        piece.cuts.back() = 1;  // also where another one grows out just before the end
        const std::vector<double> kept = piece.cuts;
        for (int k = 1; k < count; k++) {
            const double cut = piece.even_cut(double(k) / count);
            const bool free = std::all_of(kept.begin(), kept.end(),
                                          [&](double other) { return std::abs(other - cut) > 0.3 / count; });
            if (free) piece.cuts.push_back(cut);
        }
        std::sort(piece.cuts.begin(), piece.cuts.end());
    }
}

Section round_section(const Vec3& along, double radius, double taper, const Organ& organ) {
    Section section = {};
    section.length = along.norm();
    section.axis = along / section.length;
    section.thin = section.axis.unitOrthogonal();
    section.area = PI * radius * radius;
    section.inertia_thin = section.inertia_wide = section.area * radius * radius / 4;
    section.thickness = 2 * radius;
    section.taper = std::clamp(taper, -LARGEST_TAPER, LARGEST_TAPER);
    finish_section(organ, section);
    return section;
}

// Returns the direction of a section's thickness at a share of its stem.
Vec3 thin_at(const StemPiece& piece, const Vec3& axis, double share) {
    constexpr double ALONG = 1e-6;  // length of what is across, over the whole one [-]
    const Vec3 across = piece.thin - piece.thin.dot(axis) * axis;
    const bool is_open = !(across.norm() > ALONG * piece.thin.norm());
    const Vec3 thin = is_open ? Vec3(axis.unitOrthogonal()) : Vec3(across.normalized());
    const double turn = share * piece.own->twist;
    return frond::cos(turn) * thin + frond::sin(turn) * axis.cross(thin);
}

// Makes a stem's own section between two shares of its length, from the round one there.
Section own_section(const StemPiece& piece, double from, double to, const Organ& of, const Section& round) {
    const frond_stem_section& own = *piece.own;
    const double share = 0.5 * (from + to);
    Organ organ = of;
    if (own.hollow > 0) organ.material.hollow = own.hollow;
    const double begin = own.young_begin > 0 ? own.young_begin : of.material.young,
                 end = own.young_end > 0 ? own.young_end : of.material.young;
    organ.material.young = begin + share * (end - begin);
    const double radius = 0.5 * (piece.radius(from) + piece.radius(to));
    Section section = round_section(round.length * round.axis, radius, round.taper, organ);
    section.thin = thin_at(piece, section.axis, share);
    if (own.outline != FROND_OUTLINE_RECTANGLE) return section;
    const double size = piece.scale * radius / piece.radius_begin, t = size * own.thickness, w = size * own.width;
    section.area = w * t;
    section.inertia_thin = section.area * t * t / 12;
    section.inertia_wide = section.area * w * w / 12;
    finish_section(organ, section);
    return section;
}

struct StemChain {
    const std::vector<Organ>& organs;
    double given_radius;
    Chain chain = {};
    std::vector<Section> sections = {};

    int add(const Vec3& position, int parent, double radius, int organ, double taper = 0) {
        ChainNode node = {};
        node.position = position;
        node.fitted_radius = radius;
        node.radius = given_radius > 0 ? given_radius : radius;
        node.parent = parent;
        node.organ = organ;
        Vec3 along = radius * Vec3::UnitY();
        if (parent >= 0) {
            along = position - chain.nodes[size_t(parent)].position;
            node.distance = chain.nodes[size_t(parent)].distance + along.norm();
        }
        chain.nodes.push_back(node);
        sections.push_back(round_section(along, radius, taper, organs[size_t(organ)]));
        return int(chain.nodes.size()) - 1;
    }
};

// Returns the node from which a segment grows: its parent's nearest, or a new one with a capsule across the gap. Stems
// that stand at one place have one root.
int begin_of(StemChain& maker, const std::vector<StemPiece>& pieces, const StemPiece& piece) {
    if (piece.parent < 0) {
        const std::vector<ChainNode>& nodes = maker.chain.nodes;
        for (size_t i = 0; i < nodes.size(); i++)
            if (nodes[i].parent < 0 && (nodes[i].position - piece.begin).norm() <= ONE_ROOT * piece.length)
                return int(i);
        return maker.add(piece.begin, -1, piece.radius_begin, piece.organ);
    }
    const StemPiece& parent = pieces[size_t(piece.parent)];
    const double joint = parent.nearest(piece.begin);
    size_t nearest = 0;
    for (size_t k = 1; k < parent.cuts.size(); k++)
        if (std::abs(parent.cuts[k] - joint) < std::abs(parent.cuts[nearest] - joint)) nearest = k;
    const int node = parent.nodes[nearest];
    const Vec3& place = maker.chain.nodes[size_t(node)].position;
    if ((piece.begin - place).norm() <= 1e-6 * (parent.length + piece.length)) return node;
    return maker.add(piece.begin, node, piece.radius_begin, piece.organ);
}

// Assigns each vertex to the nearest capsule and the nearest node of its own segment.
void bind_vertices(StemChain& maker, const Surface& surface, const std::vector<StemPiece>& pieces) {
    maker.chain.vertex_node.assign(surface.positions.size(), 0);
    maker.chain.vertex_capsule.assign(surface.positions.size(), 0);
    maker.chain.vertex_along.assign(surface.positions.size(), 0);
    for (const Part& part : surface.parts) {
        const StemPiece& piece = pieces[size_t(std::stoi(part.name.substr(5)))];
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            for (int vertex : surface.triangles[size_t(t)]) {
                const double along = piece.nearest(surface.positions[size_t(vertex)]);
                size_t nearest = 0;
                for (size_t k = 1; k < piece.cuts.size(); k++)
                    if (std::abs(piece.cuts[k] - along) < std::abs(piece.cuts[nearest] - along)) nearest = k;
                maker.chain.vertex_node[size_t(vertex)] = piece.nodes[nearest];
                size_t end = 1;
                while (end + 1 < piece.cuts.size() && piece.cuts[end] < along) ++end;
                maker.chain.vertex_capsule[size_t(vertex)] = piece.nodes[end];
                maker.chain.vertex_along[size_t(vertex)] =
                    (along - piece.cuts[end - 1]) / (piece.cuts[end] - piece.cuts[end - 1]);
            }
    }
}

}  // namespace

void check_stem_sections(const frond_stem_section* sections, int stem_count) {
    const auto check = [](int stem, const char* what, double value, double least, double most, bool or_zero) {
        if ((value >= least && value <= most) || (or_zero && value == 0)) return;
        fail(FROND_RESULT_BAD_ARGUMENT, "%s of stem %d's section is %g; give a value from %g to %g%s", what, stem,
             value, least, most, or_zero ? ", or 0" : "");
    };
    for (int i = 0; i < stem_count; i++) {
        const frond_stem_section& own = sections[i];
        int outline;
        std::memcpy(&outline, &own.outline, sizeof outline);
        if (outline < 0 || outline >= FROND_OUTLINE_COUNT)
            fail(FROND_RESULT_BAD_ARGUMENT, "outline of stem %d's section is %d; use FROND_OUTLINE_*", i, outline);
        if (outline == FROND_OUTLINE_RECTANGLE) {
            check(i, "width [m]", own.width, 1e-9, 1e6, false);
            check(i, "thickness [m]", own.thickness, 1e-9, own.width, false);
        }
        for (const double part : {own.thin.x, own.thin.y, own.thin.z}) check(i, "thin", part, -1e9, 1e9, false);
        check(i, "twist [rad]", own.twist, -1000, 1000, false);
        check(i, "hollow", own.hollow, 0, 0.98, false);
        check(i, "young_begin [Pa]", own.young_begin, 1e3, 1e12, true);
        check(i, "young_end [Pa]", own.young_end, 1e3, 1e12, true);
    }
}

Chain make_chain_of_stems(const frond_stem* stems, int stem_count, const Surface& surface, const StemPlacement& placed,
                          const std::vector<Organ>& organs, const ChainOptions& options, std::vector<Section>& sections,
                          const std::vector<uint8_t>& are_capsules, const frond_stem_section* own) {
    std::vector<StemPiece> pieces = place_stems(stems, stem_count, surface, placed, are_capsules, own);
    const double height = options.height > 0 ? options.height : longest_way(pieces) / USUAL_STEM_COUNT;
    cut_pieces(pieces, height);
    StemChain maker = {organs, options.radius};
    for (StemPiece& piece : pieces) {
        piece.nodes.push_back(begin_of(maker, pieces, piece));
        for (size_t k = 1; k < piece.cuts.size(); k++) {
            const double begin = piece.radius(piece.cuts[k - 1]), end = piece.radius(piece.cuts[k]);
            piece.nodes.push_back(maker.add(piece.place(piece.cuts[k]), piece.nodes.back(), 0.5 * (begin + end),
                                            piece.organ, (end - begin) / (end + begin)));
            if (piece.own)
                maker.sections.back() = own_section(piece, piece.cuts[k - 1], piece.cuts[k],
                                                    organs[size_t(piece.organ)], maker.sections.back());
        }
    }
    maker.chain.height = height;
    bind_vertices(maker, surface, pieces);
    sections = std::move(maker.sections);
    return std::move(maker.chain);
}

}  // namespace frond
