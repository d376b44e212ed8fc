// Bands, second half. In: distances of points. Out: slabs of bands with their area, moments and ends, and their
// links.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/assert.hpp"
#include "core/union_find.hpp"
#include "skeleton/bands.hpp"

namespace frond {

namespace {

constexpr double TOUCH = 1e-6;  // share of a band; points nearer to a level line lie on it

struct Span {
    int low, high;
};

Span bands_of(double near, double far, double height) {
    const int low = int(std::floor(near / height + TOUCH));
    return {low, std::max(low, int(std::ceil(far / height - TOUCH)) - 1)};
}

struct Cutter {
    const Topology& topology;
    const std::vector<SharedEdge>& edges;
    const std::vector<int>& group;
    const std::vector<int>& organ;
    Bands& bands;
    std::unordered_map<uint64_t, int> link_of = {};

    double local(int triangle, int point) const {
        return bands.distance[size_t(point)] - bands.entry[size_t(topology.triangle_component[size_t(triangle)])];
    }
    int fragment(int triangle, int band) const {
        const int first = bands.first[size_t(triangle)], count = bands.first[size_t(triangle) + 1] - first;
        return first + std::clamp(band - bands.first_band[size_t(triangle)], 0, count - 1);
    }
    int band_of_fragment(int triangle, int fragment) const {
        return bands.first_band[size_t(triangle)] + fragment - bands.first[size_t(triangle)];
    }
    int band_of(double x) const { return int(std::floor(x / bands.height + TOUCH)); }
    Span span(int triangle, int u, int v) const {
        const double a = local(triangle, u), b = local(triangle, v);
        return bands_of(std::min(a, b), std::max(a, b), bands.height);
    }
    // Returns where level x crosses an edge with the distances a and b at its ends, as a share of the edge.
    static double at_level(double a, double b, double x) {
        return a == b ? 0.5 : std::clamp((x - a) / (b - a), 0.0, 1.0);
    }
    void touch(int low, int high, double length, const Vec3& middle, bool level);
};

void Cutter::touch(int low, int high, double length, const Vec3& middle, bool level) {
    if (!level && low > high) std::swap(low, high);
    const auto [at, fresh] =
        link_of.try_emplace(uint64_t(uint32_t(low)) << 32 | uint32_t(high), int(bands.links.size()));
    if (fresh) bands.links.push_back({low, high, 0, middle, level});
    SlabLink& link = bands.links[size_t(at->second)];
    link.level = link.level || level;
    // The middle is the mean weighted by length; a link that has only points keeps the first of them.
    link.length += length;
    if (length > 0) link.middle += (middle - link.middle) * (length / link.length);
}

void number_fragments(Cutter& cutter) {
    const Topology& topology = cutter.topology;
    Bands& bands = cutter.bands;
    const size_t count = topology.triangles.size();
    bands.first.resize(count + 1);
    bands.first_band.resize(count);
    int next = 0;
    for (size_t t = 0; t < count; t++) {
        double near = INFINITY, far = -INFINITY;
        for (int p : topology.triangles[t]) {
            near = std::min(near, cutter.local(int(t), p));
            far = std::max(far, cutter.local(int(t), p));
        }
        const Span span = bands_of(near, far, bands.height);
        bands.first[t] = next;
        bands.first_band[t] = span.low;
        next += span.high - span.low + 1;
    }
    bands.first[count] = next;
}

// Joins fragments of one band and group over edges and points, then numbers the sets as slabs.
void join_fragments(Cutter& cutter) {
    const Topology& topology = cutter.topology;
    Bands& bands = cutter.bands;
    UnionFind sets(size_t(bands.first.back()));
    for (const SharedEdge& edge : cutter.edges) {
        if (cutter.group[size_t(edge.triangle_a)] != cutter.group[size_t(edge.triangle_b)]) continue;
        const Span span = cutter.span(edge.triangle_a, edge.u, edge.v);
        for (int band = span.low; band <= span.high; band++) {
            // An edge on a level line separates two bands.
            const int a = cutter.fragment(edge.triangle_a, band), b = cutter.fragment(edge.triangle_b, band);
            if (cutter.band_of_fragment(edge.triangle_a, a) == cutter.band_of_fragment(edge.triangle_b, b))
                sets.join(a, b);
        }
    }
    // Around a point, each triangle is joined to the first one of its group there.
    std::vector<std::array<int, 2>> seen(topology.points.size(), {-1, -1});
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            const int fragment = cutter.fragment(int(t), cutter.band_of(cutter.local(int(t), p)));
            const int band = cutter.band_of_fragment(int(t), fragment);
            for (int& other : seen[size_t(p)]) {
                if (other < 0) other = int(t);
                const int there = cutter.fragment(other, band);
                if (cutter.group[size_t(other)] != cutter.group[t]) continue;
                if (cutter.band_of_fragment(other, there) == band) sets.join(fragment, there);
                break;
            }
        }
    bands.piece.resize(sets.parent.size());
    for (size_t i = 0; i < sets.parent.size(); i++) {
        const int set = sets.find(int(i));
        if (set == int(i)) {
            bands.piece[i] = int(bands.pieces.size());
            bands.pieces.emplace_back();
        } else {
            bands.piece[i] = bands.piece[size_t(set)];
        }
    }
}

struct Corner {
    Vec3 place;
    double x;
};

// Clips a triangle to the part between two levels. Returns its number of corners, at most five.
int clip(const std::array<Corner, 3>& triangle, double low, double high, std::array<Corner, 8>& out) {
    std::array<Corner, 8> in;
    int count = 3;
    for (size_t k = 0; k < 3; k++) out[k] = triangle[k];
    for (int side = 0; side < 2; side++) {
        const double level = side == 0 ? low : high, sign = side == 0 ? 1 : -1;
        std::copy(out.begin(), out.begin() + count, in.begin());
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const Corner &a = in[size_t(i)], &b = in[size_t((i + 1) % count)];
            const bool a_in = sign * (a.x - level) >= 0, b_in = sign * (b.x - level) >= 0;
            if (a_in) out[size_t(kept++)] = a;
            if (a_in != b_in) {
                const double share = Cutter::at_level(a.x, b.x, level);
                out[size_t(kept++)] = {a.place + share * (b.place - a.place), level};
            }
        }
        count = kept;
    }
    return count;
}

void add_area(Piece& piece, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Vec3 sum = a + b + c;
    piece.area += area;
    piece.sum += area / 3 * sum;
    piece.square += area / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
}

// Links a slab to the one in the next band along the level line between them, which runs between the corners on it of
// a polygon.
void touch_next_band(Cutter& cutter, int number, int next, const std::array<Corner, 8>& polygon, int count,
                     double level) {
    std::array<Vec3, 8> line;
    int ends = 0;
    for (int k = 0; k < count; k++)
        if (polygon[size_t(k)].x == level) line[size_t(ends++)] = polygon[size_t(k)].place;
    if (ends == 0) line[size_t(ends++)] = polygon[0].place;
    const Vec3 &a = line[0], &b = line[size_t(ends) - 1];
    cutter.touch(number, next, (a - b).norm(), 0.5 * (a + b) + cutter.bands.origin, true);
}

// Counts area of an organ for a slab, which gets the organ with the majority of its area (Boyer, Moore 1981).
void vote(Piece& piece, double& votes, int organ, double area) {
    if (piece.organ == organ) {
        votes += area;
    } else if ((votes -= area) <= 0) {
        piece.organ = organ;
        votes = std::abs(votes);
    }
}

// Measures areas, moments, distances and organs of the slabs, and the level lines between them.
void measure_pieces(Cutter& cutter) {
    const Topology& topology = cutter.topology;
    Bands& bands = cutter.bands;
    for (Piece& piece : bands.pieces) {
        piece.near = INFINITY;
        piece.far = -INFINITY;
    }
    std::vector<double> majority(bands.pieces.size(), 0.0);
    std::array<Corner, 8> polygon;
    for (size_t t = 0; t < topology.triangles.size(); t++) {
        std::array<Corner, 3> corners;
        for (size_t k = 0; k < 3; k++) {
            const int p = topology.triangles[t][k];
            corners[k] = {topology.points[size_t(p)] - bands.origin, cutter.local(int(t), p)};
        }
        const int count = bands.first[t + 1] - bands.first[t];
        for (int i = 0; i < count; i++) {
            const int fragment = bands.first[t] + i, band = bands.first_band[t] + i;
            const int number = bands.piece[size_t(fragment)];
            const double low = i == 0 ? -INFINITY : band * bands.height;
            const double high = i == count - 1 ? INFINITY : (band + 1) * bands.height;
            const int n = clip(corners, low, high, polygon);
            Piece& piece = bands.pieces[size_t(number)];
            piece.component = topology.triangle_component[t];
            piece.band = band;
            piece.group = cutter.group[t];
            const double area_before = piece.area;
            for (int k = 2; k < n; k++)
                add_area(piece, polygon[0].place, polygon[size_t(k) - 1].place, polygon[size_t(k)].place);
            for (int k = 0; k < n; k++) {
                piece.near = std::min(piece.near, polygon[size_t(k)].x);
                piece.far = std::max(piece.far, polygon[size_t(k)].x);
            }
            vote(piece, majority[size_t(number)], cutter.organ[t], piece.area - area_before);
            if (i < count - 1) touch_next_band(cutter, number, bands.piece[size_t(fragment) + 1], polygon, n, high);
        }
    }
}

// Finds links along edges, between groups and between bands where an edge lies on the level line, and links at
// single points.
void find_side_links(Cutter& cutter) {
    const Topology& topology = cutter.topology;
    const Bands& bands = cutter.bands;
    const auto touch = [&](int one, int other, double length, const Vec3& middle) {
        if (one == other) return;
        const Piece &a = bands.pieces[size_t(one)], &b = bands.pieces[size_t(other)];
        const bool level = a.group == b.group && a.band != b.band;
        if (level && b.band < a.band) std::swap(one, other);
        cutter.touch(one, other, length, middle, level);
    };
    for (const SharedEdge& edge : cutter.edges) {
        const Span span = cutter.span(edge.triangle_a, edge.u, edge.v);
        const Vec3 &u = topology.points[size_t(edge.u)], &v = topology.points[size_t(edge.v)];
        const double a = cutter.local(edge.triangle_a, edge.u), b = cutter.local(edge.triangle_a, edge.v);
        for (int band = span.low; band <= span.high; band++) {
            double begin = 0, end = 1;
            if (span.low != span.high) {
                begin = Cutter::at_level(a, b, band * bands.height);
                end = Cutter::at_level(a, b, (band + 1) * bands.height);
            }
            touch(bands.piece[size_t(cutter.fragment(edge.triangle_a, band))],
                  bands.piece[size_t(cutter.fragment(edge.triangle_b, band))], std::abs(end - begin) * (u - v).norm(),
                  u + 0.5 * (begin + end) * (v - u));
        }
    }
    std::vector<int> seen(topology.points.size(), -1);
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            const int piece = bands.piece[size_t(cutter.fragment(int(t), cutter.band_of(cutter.local(int(t), p))))];
            int& other = seen[size_t(p)];
            if (other < 0) other = piece;
            touch(other, piece, 0, topology.points[size_t(p)]);
        }
}

// Finds where each slab begins and ends: the mean of its points near the extreme distances.
void find_ends(Cutter& cutter) {
    const Topology& topology = cutter.topology;
    Bands& bands = cutter.bands;
    std::vector<int> near_count(bands.pieces.size(), 0), far_count(bands.pieces.size(), 0);
    for (Piece& piece : bands.pieces) piece.near_end = piece.far_end = Vec3::Zero();
    std::vector<int> last(topology.points.size(), -1);  // a point counts once, however many triangles meet there
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            const double x = cutter.local(int(t), p);
            const int number = bands.piece[size_t(cutter.fragment(int(t), cutter.band_of(x)))];
            if (last[size_t(p)] == number) continue;
            last[size_t(p)] = number;
            Piece& piece = bands.pieces[size_t(number)];
            const double margin = 0.1 * (piece.far - piece.near) + 1e-3 * bands.height;
            if (x >= piece.far - margin) {
                piece.far_end += topology.points[size_t(p)];
                far_count[size_t(number)]++;
            }
            if (x <= piece.near + margin) {
                piece.near_end += topology.points[size_t(p)];
                near_count[size_t(number)]++;
            }
        }
    for (size_t i = 0; i < bands.pieces.size(); i++) {
        Piece& piece = bands.pieces[i];
        const Vec3 middle = piece.area > 0 ? Vec3(piece.sum / piece.area + bands.origin) : bands.origin;
        piece.far_end = far_count[i] ? Vec3(piece.far_end / far_count[i]) : middle;
        piece.near_end = near_count[i] ? Vec3(piece.near_end / near_count[i]) : middle;
    }
}

}  // namespace

int Bands::piece_at(int triangle, double local_distance) const {
    const int begin = first[size_t(triangle)], count = first[size_t(triangle) + 1] - begin;
    const double band = std::floor(local_distance / height + TOUCH) - first_band[size_t(triangle)];
    return piece[size_t(begin + int(std::clamp(band, 0.0, double(count - 1))))];
}

static std::vector<double> entries_of(const Topology& topology, const std::vector<double>& distance) {
    std::vector<double> entry(size_t(topology.component_count), INFINITY);
    for (size_t t = 0; t < topology.triangles.size(); t++)
        for (int p : topology.triangles[t]) {
            double& least = entry[size_t(topology.triangle_component[t])];
            least = std::min(least, distance[size_t(p)]);
        }
    return entry;
}

double count_fragments(const Topology& topology, const std::vector<double>& distance, double height) {
    double count = 0;
    for (const Triangle& t : topology.triangles) {
        const double a = distance[size_t(t[0])], b = distance[size_t(t[1])], c = distance[size_t(t[2])];
        count += 1 + (std::max({a, b, c}) - std::min({a, b, c})) / height;
    }
    return count;
}

Bands cut_bands(const Topology& topology, const std::vector<SharedEdge>& edges, const std::vector<double>& distance,
                const std::vector<int>& triangle_group, const std::vector<int>& triangle_organ, double height) {
    FROND_ASSERT(height > 0);
    FROND_ASSERT(distance.size() == topology.points.size());
    FROND_ASSERT(triangle_group.size() == topology.triangles.size());
    FROND_ASSERT(triangle_organ.size() == topology.triangles.size());
    Bands bands;
    bands.height = height;
    bands.origin = topology.points.front();
    bands.distance = distance;
    bands.entry = entries_of(topology, distance);
    Cutter cutter{topology, edges, triangle_group, triangle_organ, bands};
    number_fragments(cutter);
    join_fragments(cutter);
    measure_pieces(cutter);
    find_side_links(cutter);
    find_ends(cutter);
    FROND_ASSERT(bands.piece.size() == size_t(bands.first.back()));
    FROND_ASSERT(std::all_of(bands.links.begin(), bands.links.end(), [&](const SlabLink& link) {
        return std::min(link.low, link.high) >= 0 && size_t(std::max(link.low, link.high)) < bands.pieces.size();
    }));
    return bands;
}

}  // namespace frond
