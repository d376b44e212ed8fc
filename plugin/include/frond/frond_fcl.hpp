// frond_fcl.hpp - plants for motion planners that query FCL (the Flexible Collision Library, 0.6 and 0.7) for
// collisions. Header only: needs FCL's headers and libraries beside Frond's.
//
//     frond::FclPlant<double> bean(plant, model);
//     bean.add_to(manager);                       // an fcl::BroadPhaseCollisionManager of the planner's
//     ... frond_world_step(world, dt);
//     bean.update(); manager.update();            // the same objects, where the plant is now
//
// Objects keep their addresses as long as the FclPlant lives. Failures throw std::runtime_error with
// frond_last_error(). One thread at a time, and none while the plant's world steps.
#ifndef FROND_FCL_HPP
#define FROND_FCL_HPP

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "frond/frond.h"

namespace frond {

// The part of a plant that FCL sees: its capsules, as Bullet has them, or the outside of its cage, somewhat fatter.
enum class FclParts { CAPSULES, CAGE };

template <class S>
class FclPlant {
public:
    // `model` is the plant's; it may be destroyed afterwards.
    FclPlant(frond_plant plant, frond_model model, FclParts parts = FclParts::CAPSULES) : plant(plant) {
        if (parts == FclParts::CAPSULES)
            make_capsules();
        else
            make_cage(model);
        update();
    }
    FclPlant(const FclPlant&) = delete;
    FclPlant& operator=(const FclPlant&) = delete;

    // Returns one object per capsule in their order, or a single one of the cage. Their user data is the caller's.
    const std::vector<std::unique_ptr<fcl::CollisionObject<S>>>& collision_objects() const { return objects; }
    void add_to(fcl::BroadPhaseCollisionManager<S>& manager) const {
        for (const auto& object : objects) manager.registerObject(object.get());
    }
    void remove_from(fcl::BroadPhaseCollisionManager<S>& manager) const {
        for (const auto& object : objects) manager.unregisterObject(object.get());
    }
    // Moves the objects to where the plant is now. Call manager.update() afterwards.
    void update() {
        if (cage)
            update_cage();
        else
            update_capsules();
        for (const auto& object : objects) object->computeAABB();
    }

private:
    using Bvh = fcl::BVHModel<fcl::OBBRSS<S>>;
    frond_plant plant;
    std::vector<std::shared_ptr<fcl::Capsule<S>>> capsules;
    std::shared_ptr<Bvh> cage;    // null: capsules
    std::vector<int> cage_nodes;  // the plant's node at each vertex of the cage's outside
    std::vector<std::unique_ptr<fcl::CollisionObject<S>>> objects;

    static void must(frond_result result) {
        if (result != FROND_OK) throw std::runtime_error(frond_last_error());
    }

    std::vector<frond_capsule> read_capsules() const {
        std::vector<frond_capsule> read(size_t(frond_plant_get_capsule_count(plant)));
        must(frond_plant_get_capsules(plant, read.data(), int(read.size())));
        return read;
    }
    void make_capsules() {
        for (const frond_capsule& capsule : read_capsules()) {
            capsules.push_back(std::make_shared<fcl::Capsule<S>>(S(capsule.radius), S(1)));
            objects.push_back(std::make_unique<fcl::CollisionObject<S>>(capsules.back()));
        }
    }
    // FCL's capsules stand along their z axis.
    void update_capsules() {
        const std::vector<frond_capsule> read = read_capsules();
        for (size_t i = 0; i < read.size(); i++) {
            const fcl::Vector3<S> begin(S(read[i].begin.x), S(read[i].begin.y), S(read[i].begin.z));
            const fcl::Vector3<S> end(S(read[i].end.x), S(read[i].end.y), S(read[i].end.z));
            const fcl::Vector3<S> axis = end - begin;
            capsules[i]->radius = S(read[i].radius);
            capsules[i]->lz = axis.norm();
            capsules[i]->computeLocalAABB();
            fcl::Transform3<S> frame = fcl::Transform3<S>::Identity();
            if (axis.norm() > 0) {
                frame.linear().col(2) = axis.normalized();
                frame.linear().col(0) = frame.linear().col(2).unitOrthogonal();
                frame.linear().col(1) = frame.linear().col(2).cross(frame.linear().col(0));
            }
            frame.translation() = S(0.5) * (begin + end);
            objects[i]->setTransform(frame);
        }
    }

    // Returns the faces that only one tet has, oriented outwards.
    static std::vector<std::array<int, 3>> faces_of(const frond_cage_view& view) {
        std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> seen;
        for (int t = 0; t < view.tet_count; t++) {
            const int32_t* n = view.tets + 4 * t;
            const std::array<int, 3> sides[] = {
                {n[0], n[2], n[1]}, {n[0], n[1], n[3]}, {n[0], n[3], n[2]}, {n[1], n[2], n[3]}};
            for (const std::array<int, 3>& side : sides) {
                std::array<int, 3> key = side;
                std::sort(key.begin(), key.end());
                auto& entry = seen[key];
                entry.first++;
                entry.second = side;
            }
        }
        std::vector<std::array<int, 3>> faces;
        for (const auto& [key, entry] : seen)
            if (entry.first == 1) faces.push_back(entry.second);
        return faces;
    }
    std::vector<fcl::Vector3<S>> read_cage() const {
        const int count = frond_plant_get_node_count(plant);
        std::vector<double> xyz(3 * size_t(count));
        must(frond_plant_get_state(plant, xyz.data(), nullptr, count));
        std::vector<fcl::Vector3<S>> places;
        for (int node : cage_nodes) {
            const double* p = xyz.data() + 3 * size_t(node);
            places.push_back({S(p[0]), S(p[1]), S(p[2])});
        }
        return places;
    }
    void make_cage(frond_model model) {
        frond_cage_view view;
        must(frond_model_get_cage(model, &view));
        std::vector<int> number(size_t(view.node_count), -1);
        std::vector<fcl::Triangle> triangles;
        for (const std::array<int, 3>& face : faces_of(view)) {
            size_t corners[3];
            for (int k = 0; k < 3; k++) {
                int& vertex = number[size_t(face[size_t(k)])];
                if (vertex < 0) {
                    vertex = int(cage_nodes.size());
                    cage_nodes.push_back(face[size_t(k)]);
                }
                corners[k] = size_t(vertex);
            }
            triangles.push_back(fcl::Triangle(corners[0], corners[1], corners[2]));
        }
        cage = std::make_shared<Bvh>();
        cage->beginModel();
        cage->addSubModel(read_cage(), triangles);
        cage->endModel();
        objects.push_back(std::make_unique<fcl::CollisionObject<S>>(cage));
    }
    void update_cage() {
        cage->beginReplaceModel();
        cage->replaceSubModel(read_cage());
        cage->endReplaceModel(true, true);
        cage->computeLocalAABB();
    }
};

}  // namespace frond

#endif
