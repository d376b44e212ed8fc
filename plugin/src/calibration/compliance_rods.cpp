// In: an organ's chain and sections. Out: the compliance of its rods. A tree of rods is statically determinate, so
// forces and moments follow from the loads, summed from the tip down; their products for two loads, over the stiffness,
// are the compliance (the theorem of virtual forces). Moments vary linearly along a segment, and count by their value
// at its elastic centre and by their change.
#include "calibration/compliance.hpp"

#include <cmath>

namespace frond {
namespace {

// Force and moment about the origin, one column per load.
using LoadColumns = Eigen::Matrix<double, 3, LOAD_COUNT>;
struct NodeLoads {
    LoadColumns force = LoadColumns::Zero(), moment = LoadColumns::Zero();
};

// Returns the mass of each chain node with all that grows out of it.
std::vector<double> masses_above(const Model& plant) {
    std::vector<double> masses = plant.chain_mass;
    for (size_t i = masses.size(); i-- > 0;)
        if (plant.chain.nodes[i].parent >= 0) masses[size_t(plant.chain.nodes[i].parent)] += masses[i];
    return masses;
}

// Returns the masses of an organ's nodes; the weight of what grows out of it acts where it grows.
std::vector<double> masses_of(const Model& plant, int organ) {
    const std::vector<ChainNode>& nodes = plant.chain.nodes;
    const std::vector<double> above = masses_above(plant);
    std::vector<double> mass(nodes.size(), 0.0);
    for (size_t i = 0; i < nodes.size(); i++) {
        if (nodes[i].organ == organ)
            mass[i] += plant.chain_mass[i];
        else if (nodes[i].parent >= 0 && nodes[size_t(nodes[i].parent)].organ == organ)
            mass[size_t(nodes[i].parent)] += above[i];
    }
    return mass;
}

std::vector<NodeLoads> node_loads(const Model& plant, int organ, const LoadPlaces& places) {
    const std::vector<ChainNode>& nodes = plant.chain.nodes;
    const std::vector<double> mass = masses_of(plant, organ);
    std::vector<NodeLoads> loads(nodes.size());
    for (size_t i = 0; i < nodes.size(); i++)
        for (int axis = 0; axis < 3; axis++) {
            loads[i].force.col(WEIGHT + axis) = mass[i] * places.frame.col(axis);
            loads[i].moment.col(WEIGHT + axis) = nodes[i].position.cross(Vec3(mass[i] * places.frame.col(axis)));
        }
    const auto add_force = [&](int node, int load, const Vec3& force) {
        loads[size_t(node)].force.col(load) = force;
        loads[size_t(node)].moment.col(load) = nodes[size_t(node)].position.cross(force);
    };
    for (int axis = 0; axis < 3; axis++) {
        add_force(places.tip, TIP_FORCE + axis, places.frame.col(axis));
        add_force(places.middle, MIDDLE_FORCE + axis, places.frame.col(axis));
        loads[size_t(places.tip)].moment.col(TIP_MOMENT + axis) = places.frame.col(axis);
    }
    return loads;
}

}  // namespace

LoadPlaces find_load_places(const Model& plant, int organ) {
    const std::vector<ChainNode>& nodes = plant.chain.nodes;
    const std::vector<double> mass = masses_of(plant, organ);
    LoadPlaces places;
    double sum = 0, moment = 0;
    for (size_t i = 0; i < nodes.size(); i++) {
        sum += mass[i];
        moment += mass[i] * nodes[i].distance;
        if (nodes[i].organ == organ && nodes[i].parent >= 0 &&
            (places.tip < 0 || nodes[i].distance > nodes[size_t(places.tip)].distance))
            places.tip = int(i);
    }
    if (places.tip < 0) return places;
    const auto off = [&](int node) { return std::abs(nodes[size_t(node)].distance - moment / sum); };
    places.middle = places.tip;
    for (int node = places.tip; nodes[size_t(node)].parent >= 0 && nodes[size_t(node)].organ == organ;
         node = nodes[size_t(node)].parent)
        if (off(node) < off(places.middle)) places.middle = node;
    const Section& section = plant.sections[size_t(places.tip)];
    places.frame.col(2) = section.axis;
    places.frame.col(0) = (section.thin - section.axis * section.axis.dot(section.thin)).normalized();
    places.frame.col(1) = places.frame.col(2).cross(places.frame.col(0));
    return places;
}

std::vector<Compliance> rod_compliances(const Model& plant, int organ, const LoadPlaces& places) {
    const std::vector<ChainNode>& nodes = plant.chain.nodes;
    std::vector<NodeLoads> loads = node_loads(plant, organ, places);
    std::vector<Compliance> shares(nodes.size(), Compliance::Zero());
    for (size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].organ != organ || nodes[i].parent < 0) continue;
        const size_t parent = size_t(nodes[i].parent);
        const Section& section = plant.sections[i];
        const Vec3 chord = nodes[i].position - nodes[parent].position;
        const Vec3 centre = nodes[parent].position + section.elastic_centre() * chord;
        Mat3 frame;  // thin, wide, axis
        frame << section.thin, section.wide(), section.axis;
        const LoadColumns& force = loads[i].force;
        LoadColumns moment, change;  // at the centre, and from end to end
        for (int l = 0; l < LOAD_COUNT; l++) {
            moment.col(l) = loads[i].moment.col(l) - centre.cross(Vec3(force.col(l)));
            change.col(l) = chord.cross(Vec3(force.col(l)));
        }
        // Moments about wide bend towards thin.
        const double over = section.length / plant.organ_stiffer[size_t(organ)];
        const double by_change = 1 / (section.tilting_per_bending() * section.length * section.length);
        const Vec3 soft = over * Vec3(1 / section.bending_wide(), 1 / section.bending_thin(), 1 / section.twisting());
        moment = (frame.transpose() * moment).eval();
        change = (frame.transpose() * change).eval();
        const Eigen::Matrix<double, 1, LOAD_COUNT> pull = section.axis.transpose() * force;
        shares[i] = moment.transpose() * soft.asDiagonal() * moment +
                    change.transpose() * soft.asDiagonal() * change * by_change +
                    over / section.stretching() * pull.transpose() * pull;
        loads[parent].force += force;
        loads[parent].moment += loads[i].moment;
    }
    return shares;
}

}  // namespace frond
