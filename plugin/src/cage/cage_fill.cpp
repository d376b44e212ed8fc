// Fill: how much of each tet is plant, and of which organ. A sheet gives each tet its area in the tet times its
// thickness. The volume that a closed patch encloses is cut at the cells exactly, by the divergence theorem along one
// axis, and distributed over the tets of a cell. The sum over all tets is the plant's volume.
#include <algorithm>

#include "cage/cage_parts.hpp"

namespace frond {

// Least fill of a tet, as a share of the mean fill of its copy, so that no node is without mass.
static constexpr double LEAST_SHARE = 0.1;
// Largest area that is added as a whole, as a share of a cell's face.
static constexpr double LARGEST_SAMPLE = 1.0 / 32;

namespace {

struct Filler {
    const std::vector<int>& triangle_organ;
    const std::vector<Organ>& organs;
    Draft& draft;
    std::vector<double> volume;                                       // volume of each tet [m^3]
    std::vector<double> tissue;                                       // plant in each tet [m^3]
    std::vector<double> wall;                                         // area of closed patches in each tet [m^2]
    std::vector<std::vector<std::pair<int, double>>> organ_strength;  // Young's modulus times tissue [J]
    std::vector<double> left;  // tissue of each patch that is not placed yet [m^3]
};

// Part of a closed patch's triangle in one cell, which adds to the volume in that cell and in those below it.
struct Slice {
    CellIndex cell;
    double area;    // projected along z, positive where the outside faces up [m^2]
    double volume;  // between it and its cell's floor [m^3]
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
    if (patch.filled)
        filler.wall[tet] += area;
    else if (patch.area > 0)
        filler.tissue[tet] += area * patch.tissue / patch.area;
    const int organ = filler.triangle_organ[size_t(triangle)];
    const double depth = patch.area > 0 ? patch.tissue / patch.area : 0;
    const double strength = area * depth * filler.organs[size_t(organ)].material.young;
    for (auto& [known, sum] : filler.organ_strength[tet])
        if (known == organ) {
            sum += strength;
            return;
        }
    filler.organ_strength[tet].push_back({organ, strength});
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

// Adds the area of every triangle to the tets, and lists the slices of closed patches.
static void spread_surface(Filler& filler, std::vector<std::vector<Slice>>& slices) {
    const Draft& draft = filler.draft;
    const Lattice& lattice = draft.voxels.lattice;
    const double largest = LARGEST_SAMPLE * lattice.cell_size * lattice.cell_size;
    for (int t = 0; t < int(draft.topology.triangles.size()); ++t) {
        if (draft.patches.repeated[size_t(t)]) continue;
        const size_t number = size_t(draft.patches.triangle_patch[size_t(t)]);
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
            for (int k = 2; k < part.count; ++k)
                add_parts(filler, t, last, part.corners[0], part.corners[size_t(k - 1)], part.corners[size_t(k)],
                          largest, 3);
        });
        if (draft.patches.patches[number].filled) add_slices(lattice, polygon, slices[number]);
    }
}

// Distributes a volume over the tets of a copy: in proportion to their walls if small, evenly if it fills the cell.
static void fill_copy(Filler& filler, int copy, size_t patch, double amount) {
    double whole = 0, walls = 0;
    for (int tet = copy * TETS_PER_COPY; tet < (copy + 1) * TETS_PER_COPY; ++tet) {
        whole += filler.volume[size_t(tet)];
        walls += filler.wall[size_t(tet)];
    }
    const double evenly = walls > 0 ? std::min(1.0, amount / whole) : 1;
    for (int tet = copy * TETS_PER_COPY; tet < (copy + 1) * TETS_PER_COPY; ++tet) {
        const double share = evenly * filler.volume[size_t(tet)] / whole +
                             (walls > 0 ? (1 - evenly) * filler.wall[size_t(tet)] / walls : 0);
        const double room = std::max(0.0, filler.volume[size_t(tet)] - filler.tissue[size_t(tet)]);
        const double taken = std::min(room, share * amount);
        filler.tissue[size_t(tet)] += taken;
        filler.left[patch] += share * amount - taken;
    }
}

// Finds the volume that a closed patch encloses in each cell, by summing slices column by column from the top.
static void fill_skin(Filler& filler, size_t patch, std::vector<Slice>& slices,
                      const std::vector<std::pair<CellIndex, int>>& copies_by_cell) {
    const double cell_size = filler.draft.voxels.lattice.cell_size;
    const double full = filler.draft.patches.patches[patch].tissue / filler.draft.patches.patches[patch].volume;
    std::stable_sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
        if (a.cell[0] != b.cell[0]) return a.cell[0] < b.cell[0];
        return a.cell[1] != b.cell[1] ? a.cell[1] < b.cell[1] : a.cell[2] > b.cell[2];
    });
    std::vector<int> here;
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
            if (!(amount > 0)) {
                filler.left[patch] += amount;
                continue;
            }
            const CellIndex cell = {first[0], first[1], z};
            here.clear();
            const auto begin = std::lower_bound(copies_by_cell.begin(), copies_by_cell.end(), std::make_pair(cell, -1));
            for (auto k = begin; k != copies_by_cell.end() && k->first == cell; ++k)
                if (filler.draft.copies.patch[size_t(k->second)] == int(patch)) here.push_back(k->second);
            if (here.empty()) filler.left[patch] += amount;
            for (int copy : here) fill_copy(filler, copy, patch, amount / double(here.size()));
        }
    }
}

// Places leftover tissue wherever tets have free volume, first in its own patch, then anywhere.
static void place_leftovers(Filler& filler) {
    const Draft& draft = filler.draft;
    std::vector<std::vector<int>> patch_tets(filler.left.size());
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet)
        patch_tets[size_t(draft.copies.patch[tet / TETS_PER_COPY])].push_back(int(tet));
    double rest = 0;
    const auto place = [&](const std::vector<int>& tets, double amount) {
        double room = 0, held = 0;
        for (int tet : tets) {
            room += std::max(0.0, filler.volume[size_t(tet)] - filler.tissue[size_t(tet)]);
            held += filler.tissue[size_t(tet)];
        }
        // A negative rest, from rounding or from a patch that intersects itself, reduces the tissue already there.
        const double taken = std::clamp(amount, -0.9 * held, room);
        for (int tet : tets) {
            double& tissue = filler.tissue[size_t(tet)];
            if (taken > 0)
                tissue += taken * std::max(0.0, filler.volume[size_t(tet)] - tissue) / room;
            else if (taken < 0)
                tissue += taken * tissue / held;
        }
        return amount - taken;
    };
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) {
        const double over = filler.tissue[tet] - filler.volume[tet];
        if (over <= 0) continue;
        filler.tissue[tet] = filler.volume[tet];
        filler.left[size_t(draft.copies.patch[tet / TETS_PER_COPY])] += over;
    }
    std::vector<int> all;
    for (size_t p = 0; p < patch_tets.size(); ++p)
        rest += filler.left[p] != 0 ? place(patch_tets[p], filler.left[p]) : 0;
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) all.push_back(int(tet));
    if (rest != 0) place(all, rest);
}

// Gives nearly empty tets a least fill, taken from all other tets.
static void level(Filler& filler) {
    const Draft& draft = filler.draft;
    double total = 0, whole = 0;
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) {
        total += filler.tissue[tet];
        whole += filler.volume[tet];
    }
    std::vector<double> least(filler.tissue.size(), 0);
    for (size_t first = 0; first < filler.tissue.size(); first += TETS_PER_COPY) {
        double tissue = 0, volume = 0;
        for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) {
            tissue += filler.tissue[tet];
            volume += filler.volume[tet];
        }
        const double share = LEAST_SHARE * std::max(tissue / volume, LEAST_SHARE * total / whole);
        for (size_t tet = first; tet < first + TETS_PER_COPY; ++tet) least[tet] = share * filler.volume[tet];
    }
    double added = 0, above = 0;
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) {
        added += std::max(0.0, least[tet] - filler.tissue[tet]);
        above += std::max(0.0, filler.tissue[tet] - least[tet]);
    }
    for (size_t tet = 0; tet < filler.tissue.size(); ++tet) {
        double& tissue = filler.tissue[tet];
        tissue = tissue <= least[tet] ? least[tet] : tissue - std::min(1.0, added / above) * (tissue - least[tet]);
        draft.cage.tet_fill[tet] = std::clamp(tissue / filler.volume[tet], 1e-9, 1.0);
    }
}

// Assigns each tet to the organ that adds most to its stiffness: a stem continues through cells that are full of
// leaves.
static void choose_organs(Filler& filler) {
    const Draft& draft = filler.draft;
    for (size_t tet = 0; tet < filler.organ_strength.size(); ++tet) {
        int organ = draft.patches.patches[size_t(draft.copies.patch[tet / TETS_PER_COPY])].organ;
        double most = 0;
        for (const auto& [other, strength] : filler.organ_strength[tet])
            if (strength > most) {
                most = strength;
                organ = other;
            }
        draft.cage.tet_organ[tet] = organ;
    }
}

// Returns the volume of plant of each organ: of its sheets, and its share by area in what closed patches enclose.
static std::vector<double> measure_tissue(const std::vector<int>& triangle_organ, size_t organ_count,
                                          const Draft& draft) {
    std::vector<double> tissue(organ_count, 0.0);
    for (size_t t = 0; t < triangle_organ.size(); ++t) {
        const Patch& patch = draft.patches.patches[size_t(draft.patches.triangle_patch[t])];
        if (draft.patches.repeated[t] || !(patch.area > 0)) continue;
        const Triangle& corner = draft.topology.triangles[t];
        const Vec3& a = draft.topology.points[size_t(corner[0])];
        const Vec3 u = draft.topology.points[size_t(corner[1])] - a, v = draft.topology.points[size_t(corner[2])] - a;
        tissue[size_t(triangle_organ[t])] += 0.5 * u.cross(v).norm() * patch.tissue / patch.area;
    }
    return tissue;
}

void fill_cage(const std::vector<int>& triangle_organ, const std::vector<Organ>& organs, Draft& draft) {
    const size_t count = draft.cage.tets.size();
    Filler filler{triangle_organ, organs, draft, {}, {}, {}, {}, {}};
    for (const Tet& tet : draft.cage.tets) filler.volume.push_back(tet_volume(draft.cage.nodes, tet));
    filler.tissue.assign(count, 0);
    filler.wall.assign(count, 0);
    filler.organ_strength.resize(count);
    filler.left.assign(draft.patches.patches.size(), 0);
    draft.cage.tet_fill.assign(count, 0);
    draft.cage.tet_organ.assign(count, 0);

    std::vector<std::vector<Slice>> slices(draft.patches.patches.size());
    spread_surface(filler, slices);
    std::vector<std::pair<CellIndex, int>> copies_by_cell;
    for (size_t copy = 0; copy < draft.copies.cell.size(); ++copy)
        copies_by_cell.push_back({draft.copies.cell[copy], int(copy)});
    std::sort(copies_by_cell.begin(), copies_by_cell.end());
    for (size_t p = 0; p < slices.size(); ++p) {
        if (!draft.patches.patches[p].filled) continue;
        for (const auto& cap : draft.patches.patches[p].caps)
            add_slices(draft.voxels.lattice, polygon_of(cap[0], cap[1], cap[2]), slices[p]);
        fill_skin(filler, p, slices[p], copies_by_cell);
    }
    place_leftovers(filler);
    level(filler);
    choose_organs(filler);
    draft.cage.organ_tissue = measure_tissue(triangle_organ, organs.size(), draft);
}

}  // namespace frond
