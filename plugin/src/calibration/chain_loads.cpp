#include "calibration/chain_loads.hpp"

namespace frond {

ChainLoads weigh_chain(const Model& model, int axis) {
    const std::vector<ChainNode>& nodes = model.chain.nodes;
    ChainLoads loads;
    loads.force.resize(nodes.size());
    loads.moment.assign(nodes.size(), Vec3::Zero());
    std::vector<Vec3> moment(nodes.size());  // about the origin
    for (size_t i = 0; i < nodes.size(); i++) {
        loads.force[i] = GRAVITY * model.chain_mass[i] * Vec3::Unit(axis);
        moment[i] = nodes[i].position.cross(loads.force[i]);
    }
    for (size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].parent < 0) continue;
        const size_t parent = size_t(nodes[i].parent);
        const Vec3 centre =
            nodes[parent].position + model.sections[i].elastic_centre() * (nodes[i].position - nodes[parent].position);
        loads.moment[i] = moment[i] - centre.cross(loads.force[i]);
        loads.force[parent] += loads.force[i];
        moment[parent] += moment[i];
    }
    return loads;
}

}  // namespace frond
