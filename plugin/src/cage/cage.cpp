// From a triangle soup to a cage: lattice -> cells that the surface touches or encloses -> a copy of each for each
// connected part of the plant in it -> twelve tets per copy -> the outside moved towards the surface -> share of each
// tet that is plant. After Spillmann, Wagner, Teschner 2006 ("Robust tetrahedral meshing of triangle soups": the pseudo
// volume, the lattice, the smoothed boundary), with the virtual nodes of Molino, Bao, Fedkiw 2004 instead of a signed
// distance, which open leaves do not have.
#include "cage/cage.hpp"

#include <algorithm>
#include <cmath>

#include "cage/cage_parts.hpp"
#include "core/assert.hpp"
#include "core/error.hpp"

namespace frond {

// Largest number of tets if the cell size is chosen here; with more, larger cells are tried.
static constexpr size_t MOST_TETS_TRIED = 4000;
static constexpr int TRIES = 12;

// Makes twelve tets per copy: each half of each face with the middle. The diagonals of cells whose indices add up to an
// odd number are mirrored, so that faces match.
static void make_tets(const Copies& copies, Cage& cage) {
    cage.nodes = copies.positions;
    cage.tets.reserve(copies.cell.size() * TETS_PER_COPY);
    for (size_t copy = 0; copy < copies.cell.size(); ++copy) {
        const auto& nodes = copies.nodes[copy];
        const int parity = (copies.cell[copy][0] + copies.cell[copy][1] + copies.cell[copy][2]) & 1;
        for (int face = 0; face < 6; ++face) {
            // The two edge directions of the face, and the two corners that its diagonal joins.
            const int u = 1 << (face / 2 + 1) % 3, v = 1 << (face / 2 + 2) % 3;
            const int low = face & 1 ? 1 << face / 2 : 0;
            const int begin = (face & 1) == parity ? low | u : low, end = begin ^ u ^ v;
            for (const int side : {begin ^ u, begin ^ v}) {
                Tet tet = {nodes[size_t(begin)], nodes[size_t(side)], nodes[size_t(end)], nodes[8]};
                if (tet_volume(cage.nodes, tet) < 0) std::swap(tet[0], tet[1]);
                cage.tets.push_back(tet);
            }
        }
    }
}

static void find_vertex_copies(const Surface& surface, Draft& draft) {
    std::vector<int> triangle_at(surface.positions.size(), -1);
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (int corner : surface.triangles[t]) triangle_at[size_t(corner)] = int(t);
    draft.vertex_copy.assign(surface.positions.size(), -1);
    for (size_t v = 0; v < surface.positions.size(); ++v) {
        if (triangle_at[v] < 0) continue;
        const int cell = draft.voxels.cells.find(draft.voxels.lattice.cell_of(surface.positions[v]));
        const int entry = cell < 0 ? -1 : draft.voxels.find_entry(cell, triangle_at[v]);
        if (entry >= 0) draft.vertex_copy[v] = draft.copies.entry_copy[size_t(entry)];
    }
}

static void bind_vertices(const Surface& surface, const Draft& draft, Embedding& embedding) {
    const size_t count = surface.positions.size();
    embedding.tet.assign(count, 0);
    embedding.weights.assign(count, {1, 0, 0, 0});
    Surface lost;  // vertices that belong to no triangle
    std::vector<size_t> lost_vertices;
    for (size_t v = 0; v < count; ++v) {
        if (draft.vertex_copy[v] < 0) {
            lost.positions.push_back(surface.positions[v]);
            lost_vertices.push_back(v);
            continue;
        }
        double best = -1e300;
        const int first = draft.vertex_copy[v] * TETS_PER_COPY;
        for (int tet = first; tet < first + TETS_PER_COPY; ++tet) {
            const auto weights = tet_weights(draft.cage.nodes, draft.cage.tets[size_t(tet)], surface.positions[v]);
            const double least = *std::min_element(weights.begin(), weights.end());
            if (least <= best) continue;
            best = least;
            embedding.tet[v] = tet;
            embedding.weights[v] = weights;
        }
    }
    if (lost_vertices.empty()) return;
    const Embedding found = embed(lost, draft.cage);
    for (size_t i = 0; i < lost_vertices.size(); ++i) {
        embedding.tet[lost_vertices[i]] = found.tet[i];
        embedding.weights[lost_vertices[i]] = found.weights[i];
    }
}

static std::vector<int> organs_of_triangles(const Surface& surface, size_t organ_count) {
    std::vector<int> organ(surface.triangles.size(), 0);
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t)
            if (part.organ >= 0 && size_t(part.organ) < organ_count && t >= 0 && size_t(t) < organ.size())
                organ[size_t(t)] = part.organ;
    return organ;
}

static void check(const Surface& surface, const Topology& topology, const CageOptions& options) {
    const double size = surface.size();
    if (topology.triangles.size() != surface.triangles.size() || topology.triangles.empty())
        fail(FROND_RESULT_BAD_GEOMETRY, "there are no triangles to make a cage around");
    if (!std::isfinite(options.cell_size) || options.cell_size < 0)
        fail(FROND_RESULT_BAD_ARGUMENT, "cage_size is %g; it must be 0 (chosen) or a length in metres",
             options.cell_size);
    if (!std::isfinite(options.offset) || options.offset < 0 || options.offset > size)
        fail(FROND_RESULT_BAD_ARGUMENT, "cage_offset is %g m; it must lie in 0 .. %g, the plant's size", options.offset,
             size);
    if (!(options.smoothness >= 0 && options.smoothness <= 1))
        fail(FROND_RESULT_BAD_ARGUMENT, "cage_smoothness is %g; it must lie in 0 .. 1", options.smoothness);
}

static bool have_volume(const Cage& cage) {
    for (const Tet& tet : cage.tets)
        if (!(tet_volume(cage.nodes, tet) > 0)) return false;
    return true;
}

void make_cage(const Surface& surface, const Topology& topology, const std::vector<Organ>& organs,
               const CageOptions& options, Cage& cage, Embedding& embedding) {
    check(surface, topology, options);
    const std::vector<Organ> organ =
        organs.empty() ? std::vector<Organ>{{"plant", "stem", *material_preset("stem")}} : organs;
    const std::vector<int> triangle_organ = organs_of_triangles(surface, organ.size());
    const Patches patches = make_patches(topology, triangle_organ, organ);
    double cell_size = options.cell_size > 0 ? options.cell_size : choose_cell_size(topology, options.offset);
    for (int tried = 1;; ++tried) {
        const Voxels voxels = make_voxels(topology, make_lattice(topology, cell_size), options.offset);
        const Copies copies = make_copies(topology, patches, voxels);
        if (options.cell_size == 0 && tried < TRIES && TETS_PER_COPY * copies.cell.size() > MOST_TETS_TRIED) {
            cell_size *= 1.2;
            continue;
        }
        cage = {};
        Draft draft{topology, patches, voxels, copies, cage, {}};
        make_tets(copies, cage);
        find_vertex_copies(surface, draft);
        bind_vertices(surface, draft, embedding);
        smooth_cage(surface, options, draft, embedding);
        fill_cage(organ, draft);
        FROND_ASSERT(have_volume(cage));
        FROND_ASSERT(embedding.tet.size() == surface.positions.size());
        FROND_ASSERT(cage.tet_organ.size() == cage.tets.size() && cage.tet_fill.size() == cage.tets.size());
        return;
    }
}

}  // namespace frond
