// Cages that collide: boxes and trees of tets at given positions.
#pragma once

#include "collide/cage_contact.hpp"
#include "support/meshes.hpp"
#include "support/referee.hpp"

namespace frond::test {

struct TestCage {
    Collider collider;
    std::vector<Vec3> places;

    CollisionBody body(bool with_itself = false) const {
        return {&collider, places.data(), std::vector<uint8_t>(size_t(collider.piece_count), 1), with_itself};
    }
    void move(const Vec3& by) {
        for (Vec3& place : places) place += by;
    }
    void turn(const Mat3& rotation) {
        for (Vec3& place : places) place = rotation * place;
    }
    Vec3 middle() const {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& place : places) sum += place;
        return sum / double(places.size());
    }
    TriangleMesh boundary() const { return {places, collider.faces}; }
};

// Makes a cage with a region for every `length` along the axis.
inline TestCage cage_of(const Model& model, int axis, double length) {
    const Cage& cage = model.cage;
    std::vector<int> piece;
    int count = 1;
    for (const Tet& tet : cage.tets) {
        double middle = 0;
        for (const int n : tet) middle += cage.nodes[size_t(n)][axis] / 4;
        piece.push_back(int(middle / length));
        count = std::max(count, piece.back() + 1);
    }
    return {make_collider(cage.nodes, cage.tets, piece, cage.tet_organ, count), cage.nodes};
}

// Makes a box from the origin to `size`, in one region unless specified.
inline TestCage box_cage(int nx, int ny, int nz, const Vec3& size, double piece_length = 1e9) {
    return cage_of(box_model(nx, ny, nz, size), 0, piece_length);
}

// Makes a stem with limbs, in regions by height; a limb belongs to the regions of its height.
inline TestCage tree_cage(int stem_cells, int limbs, int limb_cells) {
    return cage_of(tree_model(stem_cells, limbs, limb_cells), 1, 0.2);
}

inline std::vector<CageContact> contacts_of(const std::vector<CollisionBody>& bodies,
                                            const HashSettings& settings = {}) {
    const ContactSearchPtr search = make_contact_search();
    std::vector<CageContact> contacts;
    find_cage_contacts(*search, bodies, settings, contacts);
    return contacts;
}

inline Vec3 place_of(const std::vector<CollisionBody>& bodies, const ContactSide& side) {
    Vec3 sum = Vec3::Zero();
    for (size_t k = 0; k < 4; ++k) sum += side.weights[k] * bodies[size_t(side.body)].places[size_t(side.nodes[k])];
    return sum;
}

}  // namespace frond::test
