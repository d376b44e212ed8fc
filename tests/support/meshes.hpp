// Small models of tets for tests: boxes, one tet, trees; only what mechanics and solve need is filled in.
#pragma once

#include <cmath>
#include <memory>
#include <random>

#include "cage/tet_geometry.hpp"
#include "model/model.hpp"
#include "support/materials.hpp"

namespace frond::test {

struct Stuff {
    double density = 1000;  // [kg/m^3]
    double young = 1e6;     // [Pa]
    double poisson = 0.3;
};

// Gives every tet the same material.
inline void set_stuff(Model& model, const Stuff& stuff) {
    const size_t n = model.cage.tets.size();
    model.tet_density.assign(n, stuff.density);
    model.tet_young.assign(n, stuff.young);
    model.tet_poisson.assign(n, stuff.poisson);
    model.cage.tet_organ.assign(n, 0);
    model.cage.tet_fill.assign(n, 1.0);
    if (model.organs.empty())
        model.organs.push_back({"stem", "stem", plain_material(stuff.density, stuff.young, stuff.poisson, 1e-3)});
}

// Adds a tet with positive volume, whatever the order of its nodes.
inline void add_tet(Cage& cage, Tet tet) {
    if (tet_volume(cage.nodes, tet) < 0) std::swap(tet[2], tet[3]);
    cage.tets.push_back(tet);
}

// Cuts a hexahedron (corner bits: 1 = +x, 2 = +y, 4 = +z) into five tets; odd ones are mirrored so that faces match.
inline void add_hexahedron(Cage& cage, const std::array<int, 8>& c, bool odd) {
    if (odd) {
        add_tet(cage, {c[0], c[3], c[5], c[6]});
        add_tet(cage, {c[1], c[0], c[3], c[5]});
        add_tet(cage, {c[2], c[0], c[3], c[6]});
        add_tet(cage, {c[4], c[0], c[5], c[6]});
        add_tet(cage, {c[7], c[3], c[5], c[6]});
    } else {
        add_tet(cage, {c[1], c[2], c[4], c[7]});
        add_tet(cage, {c[0], c[1], c[2], c[4]});
        add_tet(cage, {c[3], c[1], c[2], c[7]});
        add_tet(cage, {c[5], c[1], c[4], c[7]});
        add_tet(cage, {c[6], c[2], c[4], c[7]});
    }
}

// Makes a box of `size` [m] at the origin, nx*ny*nz hexahedra of five tets; node (i, j, k): (k*(ny+1)+j)*(nx+1)+i.
inline Model box_model(int nx, int ny, int nz, const Vec3& size, const Stuff& stuff = {}) {
    Model model;
    const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i)
                model.cage.nodes.push_back({size.x() * i / nx, size.y() * j / ny, size.z() * k / nz});
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                std::array<int, 8> corner;
                for (int c = 0; c < 8; ++c) corner[size_t(c)] = node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
                add_hexahedron(model.cage, corner, (i + j + k) % 2 != 0);
            }
    set_stuff(model, stuff);
    return model;
}

inline std::shared_ptr<const Model> shared_box(int nx, int ny, int nz, const Vec3& size, const Stuff& stuff = {}) {
    return std::make_shared<const Model>(box_model(nx, ny, nz, size, stuff));
}

// Makes one tet with edges of `size` [m] along the axes.
inline Model single_tet_model(double size = 1, const Stuff& stuff = {}) {
    Model model;
    model.cage.nodes = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    model.cage.tets = {{0, 1, 2, 3}};
    set_stuff(model, stuff);
    return model;
}

// Adds a chain of hexahedra: continues the square of nodes `base` by `count` cells along `step` each.
inline std::array<int, 4> grow_limb(Cage& cage, std::array<int, 4> base, const Vec3& step, int count, double taper) {
    for (int n = 0; n < count; ++n) {
        Vec3 middle = Vec3::Zero();
        for (int b : base) middle += cage.nodes[size_t(b)] / 4;
        std::array<int, 4> top;
        for (size_t b = 0; b < 4; ++b) {
            top[b] = int(cage.nodes.size());
            cage.nodes.push_back(middle + step + taper * (cage.nodes[size_t(base[b])] - middle));
        }
        add_hexahedron(cage, {base[0], base[1], base[2], base[3], top[0], top[1], top[2], top[3]}, n % 2 != 0);
        base = top;
    }
    return base;
}

// Makes a plant-like tree along +y: a stem of `stem_cells` cells with `limbs` limbs of `limb_cells` cells each, five
// tets per cell. Limbs grow from a side face of the stem and alternate around it. (30, 20, 10) gives 1150 tets.
inline Model tree_model(int stem_cells, int limbs, int limb_cells, const Stuff& stuff = {}) {
    Model model;
    Cage& cage = model.cage;
    const double width = 0.03, cell = 0.05;
    for (int c = 0; c < 4; ++c) cage.nodes.push_back({width * (c & 1), 0, width * (1 - (c >> 1))});
    std::vector<std::array<int, 4>> rings = {{0, 1, 2, 3}};
    for (int n = 0; n < stem_cells; ++n) rings.push_back(grow_limb(cage, rings.back(), {0, cell, 0}, 1, 0.99));
    for (int l = 0; l < limbs; ++l) {
        // The side face between two rings of the stem carries the limb.
        const size_t ring = size_t(1 + l * (stem_cells - 1) / std::max(limbs, 1));
        const auto &low = rings[ring - 1], &high = rings[ring];
        const int side = l % 4;
        const std::array<std::array<size_t, 2>, 4> edges = {{{0, 1}, {3, 2}, {1, 3}, {2, 0}}};
        const size_t a = edges[size_t(side)][0], b = edges[size_t(side)][1];
        const std::array<Vec3, 4> out = {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)};
        grow_limb(cage, {low[a], low[b], high[a], high[b]}, 0.04 * (out[size_t(side)] + Vec3(0, 0.4, 0)), limb_cells,
                  0.93);
    }
    set_stuff(model, stuff);
    return model;
}

inline VecX positions_of(const Model& model) {
    VecX x(3 * Eigen::Index(model.cage.nodes.size()));
    for (size_t i = 0; i < model.cage.nodes.size(); ++i) point(x, int(i)) = model.cage.nodes[i];
    return x;
}

// Random numbers that are the same with every compiler and library.
struct Dice {
    std::mt19937_64 engine;
    explicit Dice(uint64_t seed) : engine(seed) {}
    double uniform(double low, double high) { return low + (high - low) * double(engine() >> 11) * 0x1p-53; }
    VecX vector(Eigen::Index n, double size) {
        VecX v(n);
        for (Eigen::Index i = 0; i < n; ++i) v[i] = uniform(-size, size);
        return v;
    }
    Mat3 rotation() {
        const Vec3 axis = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
        return Eigen::AngleAxisd(uniform(-3.1, 3.1), axis).toRotationMatrix();
    }
};

}  // namespace frond::test
