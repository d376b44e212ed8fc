// Fill: how much of each tet is plant, and of which organs. A sheet gives each tet its area in the tet times its
// thickness. The volume that a closed patch encloses is cut at the cells exactly, by the divergence theorem along one
// axis, and distributed over the tets of a cell. The sum over all tets is the plant's volume.
#include <algorithm>

#include "cage/cage_filler.hpp"
#include "cage/shift_centre.hpp"

namespace frond {

// Largest area that is added as a whole, as a share of a cell's face.
static constexpr double LARGEST_SAMPLE = 1.0 / 32;

namespace {

// Part of a closed patch's triangle in one cell, which adds to the volume in that cell and in those below it.
struct Slice {
    CellIndex cell;
    double area;    // projected along z, positive where the outside faces up [m^2]
    double volume;  // between it and its cell's floor [m^3]
};

// A closed patch cut at the cells.
struct Solid {
    std::vector<Slice> slices;
    std::vector<std::pair<CellIndex, int>> copies;  // those that carry it, by cell
};

}  // namespace

static int tet_at(const Filler& filler, int copy, const Vec3& place) {
    const Cage& cage = filler.draft.cage;
    int best = -1;
    double most = -1e300;
    for (int tet = copy * TETS_PER_COPY; tet < (copy + 1) * TETS_PER_COPY; ++tet) {
        const auto weights = tet_weights(cage.nodes, cage.tets[size_t(tet)], place);
        const double least = *std::min_element(weights.begin(), weights.end());
        if (least <= most) continue;
        most = least;
        best = tet;
    }
    return best;
}

static void add_area(Filler& filler, int triangle, int copy, double area, const Vec3& place) {
    const size_t tet = size_t(tet_at(filler, copy, place));
    const size_t number = size_t(filler.draft.patches.triangle_patch[size_t(triangle)]);
    const Patch& patch = filler.draft.patches.patches[number];
    const double tissue = patch.area > 0 ? area * patch.tissue / patch.area : 0;
    Held& held = filler.of(tet, patch.organ);
    held.strength += tissue * filler.organs[size_t(patch.organ)].material.young;
    if (patch.filled) {
        held.wall += area;
        return;
    }
    held.tissue += tissue;
    filler.tissue[tet] += tissue;
}

// Splits a triangle until its parts are small, and adds them.
static void add_parts(Filler& filler, int triangle, int copy, const Vec3& a, const Vec3& b, const Vec3& c,
                      double largest, int depth) {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    if (area <= largest || depth == 0) return add_area(filler, triangle, copy, area, (a + b + c) / 3);
    const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    add_parts(filler, triangle, copy, a, ab, ca, largest, depth - 1);
    add_parts(filler, triangle, copy, ab, b, bc, largest, depth - 1);
    add_parts(filler, triangle, copy, ca, bc, c, largest, depth - 1);
    add_parts(filler, triangle, copy, ab, bc, ca, largest, depth - 1);
}

static void add_slices(const Lattice& lattice, const Polygon& polygon, std::vector<Slice>& slices) {
    visit_cells(lattice, 0, polygon, [&](const CellIndex& cell, const Polygon& part) {
        double area = 0;
        for (int k = 2; k < part.count; ++k) {
            const Vec3 u = part.corners[size_t(k - 1)] - part.corners[0], v = part.corners[size_t(k)] - part.corners[0];
            area += 0.5 * (u.x() * v.y() - u.y() * v.x());
        }
        Vec3 centre;
        area_of(part, centre);
        slices.push_back({cell, area, area * (centre.z() - lattice.low(cell).z())});
    });
}

// Adds the area of every triangle to the tets, and cuts closed patches at the cells.
static void spread_surface(Filler& filler, std::vector<Solid>& solids) {
    const Draft& draft = filler.draft;
    const Lattice& lattice = draft.voxels.lattice;
    const double largest = LARGEST_SAMPLE * lattice.cell_size * lattice.cell_size;
    for (int t = 0; t < int(draft.topology.triangles.size()); ++t) {
        if (draft.patches.repeated[size_t(t)]) continue;
        const size_t number = size_t(draft.patches.triangle_patch[size_t(t)]);
        const bool filled = draft.patches.patches[number].filled;
        Triangle corner = draft.topology.triangles[size_t(t)];
        if (draft.patches.flipped[size_t(t)]) std::swap(corner[1], corner[2]);
        const Polygon polygon =
            polygon_of(draft.topology.points[size_t(corner[0])], draft.topology.points[size_t(corner[1])],
                       draft.topology.points[size_t(corner[2])]);
        int last = -1;
        visit_cells(lattice, 0, polygon, [&](const CellIndex& cell, const Polygon& part) {
            const int found = draft.voxels.cells.find(cell);
            const int entry = found < 0 ? -1 : draft.voxels.find_entry(found, t);
            if (entry >= 0) last = draft.copies.entry_copy[size_t(entry)];
            if (last < 0) return;
            if (filled && entry >= 0) solids[number].copies.push_back({cell, last});
            for (int k = 2; k < part.count; ++k)
                add_parts(filler, t, last, part.corners[0], part.corners[size_t(k - 1)], part.corners[size_t(k)],
                          largest, 3);
        });
        if (filled) add_slices(lattice, polygon, solids[number].slices);
    }
}

// Lists the copies that carry each closed patch, with those inside it, and closes its holes.
static void complete_solids(const Draft& draft, std::vector<Solid>& solids) {
    const std::vector<Patch>& patches = draft.patches.patches;
    for (size_t copy = 0; copy < draft.copies.cell.size(); ++copy) {
        const size_t patch = size_t(draft.copies.patch[copy]);
        if (patches[patch].filled) solids[patch].copies.push_back({draft.copies.cell[copy], int(copy)});
    }
    for (size_t p = 0; p < solids.size(); ++p) {
        auto& copies = solids[p].copies;
        std::sort(copies.begin(), copies.end());
        copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
        if (!patches[p].filled) continue;
        for (const auto& cap : patches[p].caps)
            add_slices(draft.voxels.lattice, polygon_of(cap[0], cap[1], cap[2]), solids[p].slices);
    }
}

static double wall_in(const Filler& filler, int copy, int organ) {
    double sum = 0;
    for (int tet = copy * TETS_PER_COPY; tet < (copy + 1) * TETS_PER_COPY; ++tet)
        sum += filler.wall_of(size_t(tet), organ);
    return sum;
}

// Distributes a volume over the tets of a copy: in proportion to their walls if small, evenly if it fills the cell.
static void fill_copy(Filler& filler, int copy, int organ, double amount) {
    const double walls = wall_in(filler, copy, organ);
    double whole = 0;
    for (int tet = copy * TETS_PER_COPY; tet < (copy + 1) * TETS_PER_COPY; ++tet) whole += filler.volume[size_t(tet)];
    const double evenly = walls > 0 ? std::min(1.0, amount / whole) : 1;
    for (size_t tet = size_t(copy) * TETS_PER_COPY; tet < size_t(copy + 1) * TETS_PER_COPY; ++tet) {
        const double share =
            evenly * filler.volume[tet] / whole + (walls > 0 ? (1 - evenly) * filler.wall_of(tet, organ) / walls : 0);
        const double taken = std::min(filler.room(tet), share * amount);
        filler.add(tet, organ, taken);
        filler.left[size_t(organ)] += share * amount - taken;
    }
}

// Distributes a volume in a cell over the copies that carry its patch, in proportion to their walls.
static void fill_cell(Filler& filler, const Solid& solid, const CellIndex& cell, int organ, double amount) {
    const auto begin = std::lower_bound(solid.copies.begin(), solid.copies.end(), std::make_pair(cell, -1));
    auto end = begin;
    double walls = 0;
    for (; end != solid.copies.end() && end->first == cell; ++end) walls += wall_in(filler, end->second, organ);
    if (begin == end) filler.left[size_t(organ)] += amount;
    for (auto at = begin; at != end; ++at)
        fill_copy(filler, at->second, organ,
                  amount * (walls > 0 ? wall_in(filler, at->second, organ) / walls : 1 / double(end - begin)));
}

// Finds the volume that a closed patch encloses in each cell, by summing slices column by column from the top.
static void fill_solid(Filler& filler, const Patch& patch, Solid& solid) {
    const double cell_size = filler.draft.voxels.lattice.cell_size;
    const double full = patch.tissue / patch.volume;
    std::vector<Slice>& slices = solid.slices;
    std::stable_sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
        if (a.cell[0] != b.cell[0]) return a.cell[0] < b.cell[0];
        return a.cell[1] != b.cell[1] ? a.cell[1] < b.cell[1] : a.cell[2] > b.cell[2];
    });
    double above = 0;
    for (size_t i = 0; i < slices.size();) {
        const bool new_column =
            i == 0 || slices[i].cell[0] != slices[i - 1].cell[0] || slices[i].cell[1] != slices[i - 1].cell[1];
        if (new_column) above = 0;
        const CellIndex first = slices[i].cell;
        double volume = above * cell_size * cell_size * cell_size;
        for (; i < slices.size() && slices[i].cell == first; ++i) {
            volume += slices[i].volume;
            above += slices[i].area / (cell_size * cell_size);
        }
        // Fills this cell, and the cells below it down to the next slice to the share that the slices above add up to.
        const bool goes_on = i < slices.size() && slices[i].cell[0] == first[0] && slices[i].cell[1] == first[1];
        const int end = goes_on ? slices[i].cell[2] : first[2] - 1;
        for (int z = first[2]; z > end; --z) {
            const double amount = full * (z == first[2] ? volume : above * cell_size * cell_size * cell_size);
            if (amount > 0)
                fill_cell(filler, solid, {first[0], first[1], z}, patch.organ, amount);
            else
                filler.left[size_t(patch.organ)] += amount;
        }
    }
}

// Assigns each tet to the organ that adds most to its stiffness: a stem continues through cells that are full of
// leaves.
static int strongest_organ(const Filler& filler, size_t tet) {
    int organ = filler.main_organ(tet);
    double most = 0;
    for (const Held& held : filler.held[tet])
        if (held.strength > most) {
            most = held.strength;
            organ = held.organ;
        }
    return organ;
}

static void write_tissue(const Filler& filler, Cage& cage) {
    constexpr double LEAST = 1e-9;  // fill of a tet whose organs have no tissue at all
    for (size_t tet = 0; tet < filler.volume.size(); ++tet) {
        cage.tet_organ.push_back(strongest_organ(filler, tet));
        const double least = LEAST * filler.volume[tet];
        cage.tet_fill.push_back(std::clamp(filler.tissue[tet] / filler.volume[tet], LEAST, 1.0));
        if (filler.tissue[tet] <= least) cage.tissue.push_back({int(tet), cage.tet_organ.back(), least});
        if (filler.tissue[tet] <= least) continue;
        for (const Held& held : filler.held[tet])
            if (held.tissue > 0) cage.tissue.push_back({int(tet), held.organ, held.tissue});
    }
}

// Brings the centre of each organ's tissue, which a tet carries at its own centre, to where the surface shows it.
static void centre_tissue(const std::vector<Patch>& patches, size_t organ_count, Cage& cage) {
    std::vector<double> volume(organ_count, 0.0);
    cage.organ_centre.assign(organ_count, Vec3::Zero());
    for (const Patch& patch : patches) {
        volume[size_t(patch.organ)] += patch.tissue;
        cage.organ_centre[size_t(patch.organ)] += patch.tissue * patch.centre;
    }
    std::vector<std::vector<Tissue*>> parts(organ_count);
    for (Tissue& part : cage.tissue) parts[size_t(part.organ)].push_back(&part);
    std::vector<Vec3> places;
    std::vector<double> volumes;
    for (size_t o = 0; o < organ_count; ++o) {
        if (!(volume[o] > 0)) continue;
        cage.organ_centre[o] /= volume[o];
        places.clear();
        volumes.clear();
        for (const Tissue* part : parts[o]) {
            places.push_back(tet_centre(cage.nodes, cage.tets[size_t(part->tet)]));
            volumes.push_back(part->volume);
        }
        shift_centre(places, cage.organ_centre[o], volumes);
        for (size_t i = 0; i < volumes.size(); ++i) parts[o][i]->volume = volumes[i];
    }
}

void fill_cage(const std::vector<Organ>& organs, Draft& draft) {
    const size_t count = draft.cage.tets.size();
    Filler filler{organs, draft, {}, {}, {}, {}};
    for (const Tet& tet : draft.cage.tets) filler.volume.push_back(tet_volume(draft.cage.nodes, tet));
    filler.tissue.assign(count, 0);
    filler.held.resize(count);
    filler.left.assign(organs.size(), 0);

    std::vector<Solid> solids(draft.patches.patches.size());
    spread_surface(filler, solids);
    complete_solids(draft, solids);
    for (size_t p = 0; p < solids.size(); ++p)
        if (draft.patches.patches[p].filled) fill_solid(filler, draft.patches.patches[p], solids[p]);
    place_leftovers(filler);
    level_tissue(filler);
    write_tissue(filler, draft.cage);
    centre_tissue(draft.patches.patches, organs.size(), draft.cage);
}

}  // namespace frond
