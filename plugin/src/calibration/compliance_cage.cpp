// In: an organ's cage, alone. Out: the compliance of the cage, tet by tet.
#include <Eigen/LU>

#include "cage/tet_geometry.hpp"
#include "calibration/compliance.hpp"
#include "calibration/tet_products.hpp"

namespace frond {
namespace {

// Returns, for nodes of an organ, the volume around them of tets that hang on the chain within `reach` of a point.
std::map<int, double> nodes_near(const LoneOrgan& lone, const Model& plant, const std::vector<int>& hangs,
                                 const Vec3& place, double reach) {
    const std::vector<ChainNode>& chain = plant.chain.nodes;
    std::map<int, double> nodes;
    for (size_t e = 0; e < lone.tets.size(); e++) {
        const ChainNode& node = chain[size_t(hangs[lone.tets[e]])];
        if (node.organ != lone.organ || (node.position - place).norm() > reach) continue;
        const double volume = tet_volume(lone.model.cage.nodes, lone.model.cage.tets[e]);
        for (int corner : lone.model.cage.tets[e])
            if (!lone.model.root[size_t(corner)]) nodes[corner] += volume;
    }
    return nodes;
}

// Distributes a force and a moment at a point over weighted nodes, so that for any displacement of the nodes their work
// is that of the force and the moment on the closest rigid body. False if the nodes lie on a line.
bool share_out(const LoneOrgan& lone, const std::map<int, double>& nodes, const Vec3& place, const Mat3& frame,
               int first_force, int first_moment, CageLoads& loads) {
    double whole = 0;
    Vec3 centre = Vec3::Zero();
    for (const auto& [node, weight] : nodes) {
        whole += weight;
        centre += weight * lone.model.cage.nodes[size_t(node)];
    }
    if (nodes.size() < 3) return false;
    centre /= whole;
    Mat3 inertia = Mat3::Zero();
    for (const auto& [node, weight] : nodes) {
        const Vec3 d = lone.model.cage.nodes[size_t(node)] - centre;
        inertia += weight * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    }
    const double size = inertia.trace() / 3;
    if (!(inertia.determinant() > 1e-6 * size * size * size)) return false;
    const Mat3 inverse = inertia.inverse();
    for (const auto& [node, weight] : nodes) {
        const Vec3 d = lone.model.cage.nodes[size_t(node)] - centre;
        for (int axis = 0; axis < 3; axis++) {
            const Vec3 unit = frame.col(axis);
            const Vec3 turn = inverse * (place - centre).cross(unit);
            loads.col(first_force + axis).segment<3>(3 * node) = weight * (unit / whole + turn.cross(d));
            if (first_moment >= 0)
                loads.col(first_moment + axis).segment<3>(3 * node) = weight * Vec3(inverse * unit).cross(d);
        }
    }
    return true;
}

}  // namespace

double mean_edge(const Cage& cage) {
    double sum = 0;
    for (const Tet& tet : cage.tets)
        for (size_t a = 0; a < 4; a++)
            for (size_t b = 0; b < a; b++) sum += (cage.nodes[size_t(tet[a])] - cage.nodes[size_t(tet[b])]).norm();
    return sum / (6 * double(cage.tets.size()));
}

CageLoads cage_loads(const LoneOrgan& lone, const TetElements& elements, const Model& plant,
                     const std::vector<int>& hangs, const LoadPlaces& places) {
    CageLoads loads = CageLoads::Zero(3 * elements.node_count, LOAD_COUNT);
    const double edge = mean_edge(lone.model.cage);
    const auto load = [&](int node, int first_force, int first_moment) {
        const Vec3& place = plant.chain.nodes[size_t(node)].position;
        for (double reach = edge; reach < 16 * edge; reach *= 2)
            if (share_out(lone, nodes_near(lone, plant, hangs, place, reach), place, places.frame, first_force,
                          first_moment, loads))
                return;
    };
    load(places.tip, TIP_FORCE, TIP_MOMENT);
    load(places.middle, MIDDLE_FORCE, -1);
    VecX masses = mechanics(FROND_MECHANICS_TET_LINEAR, elements.nodes.order).masses(elements, FROND_MASS_LUMPED).node;
    for (const auto& [node, mass] : lone.borne) masses[node] += mass;
    for (int node = 0; node < elements.node_count; node++)
        for (int axis = 0; axis < 3; axis++)
            loads.col(WEIGHT + axis).segment<3>(3 * node) = masses[node] * places.frame.col(axis);
    const std::vector<uint8_t> held = with_middles(elements.nodes, lone.model.root);
    for (size_t node = 0; node < held.size(); node++)
        if (held[node]) loads.middleRows<3>(3 * Eigen::Index(node)).setZero();
    return loads;
}

std::vector<Compliance> cage_compliances(const LoneOrgan& lone, const TetElements& elements, StaticStiffness& stiffness,
                                         const CageLoads& loads) {
    const int order = elements.nodes.order;
    if (!stiffness.set(elements, with_middles(elements.nodes, lone.model.root),
                       mechanics(FROND_MECHANICS_TET_LINEAR, order), Tangent::positive, elements.rest_positions))
        return {};
    std::array<VecX, LOAD_COUNT> moves;
    for (int l = 0; l < LOAD_COUNT; l++) {
        moves[size_t(l)].resize(loads.rows());
        solve(stiffness.factor, loads.col(l), moves[size_t(l)]);
    }
    const std::vector<TetProducts<LOAD_COUNT>> of_tets = products_of_tets<LOAD_COUNT>(elements, moves);
    std::vector<Compliance> shares;
    for (const auto& of_tet : of_tets) shares.push_back(of_tet.tissue);
    for (const auto& of_tet : of_tets) shares.push_back(of_tet.grain);
    return shares;
}

Compliance sum_of(const std::vector<Compliance>& shares) {
    Compliance sum = Compliance::Zero();
    for (const Compliance& share : shares) sum += share;
    return sum;
}

}  // namespace frond
