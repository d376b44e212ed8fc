// In: rods and their nodes' positions and rotations. Out: the plastic part of their curvature. A segment yields by the
// strain of its outermost fibre under its two curvatures. The return to what the section bears scales both of them
// alike. The plastic bend turns the frame in which twist and tilt are measured: where the plant would gain elastic
// energy by it, each segment yields only as much as leaves it no more than it had. Twist, tilt and stretch stay
// elastic: along its axis tissue breaks before it flows.
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/lists.hpp"
#include "mechanics/rod_elements.hpp"
#include "mechanics/rows.hpp"

namespace frond {

namespace {

constexpr size_t NUMBERS_OF_PIECE = 3;  // the two curvatures, hardening

// What a segment's yielding would make plastic.
struct Flow {
    size_t segment;
    Vec3 from, curvature;  // plastic curvature before, and what is added to it [1/m]
    double hardening;      // after it
};

// Returns the elastic energy of a segment [J].
double segment_energy(const RodSegment& rod, const RodStrain& s) {
    return 0.5 * rod.length * (rod.stretch.dot(s.strain.cwiseAbs2()) + rod.bend.dot(s.curvature.cwiseAbs2()));
}

}  // namespace

FibreStrain fibre_strain(const RodSegment& rod, const RodStrain& s) {
    return {std::abs(s.strain[0]), frond::hypot(rod.reach_wide * s.curvature[1], rod.reach_thin * s.curvature[2])};
}

void let_rods_yield(const Model& model, RodElements& elements) {
    std::vector<Yield> yields;
    for (const RodSegment& rod : elements.segments)
        yields.push_back(yield_of(model, model.chain.nodes[size_t(rod.b)].organ));
    if (std::all_of(yields.begin(), yields.end(), [](const Yield& y) { return y.strain == 0; })) return;
    const std::vector<RodStrain> standing = rod_strains(elements, elements.modelled);
    for (size_t s = 0; s < yields.size(); ++s)
        if (yields[s].strain > 0)
            yields[s].strain = firm_strain(yields[s].strain, fibre_strain(elements.segments[s], standing[s]).bend);
    elements.yields = std::move(yields);
}

bool rods_yield(const Elements& body, const VecX& x) {
    const RodElements& elements = as_rods(body);
    const std::vector<RodStrain> strains = rod_strains(elements, x);
    for (size_t s = 0; s < strains.size(); ++s) {
        const double most = elements.yields[s].strain;
        if (most > 0 && fibre_strain(elements.segments[s], strains[s]).bend > most) return true;
    }
    return false;
}

std::unique_ptr<Elements> copy_rods(const Elements& body) {
    auto own = std::make_unique<RodElements>(as_rods(body));
    own->hardening.assign(own->segments.size(), 0);
    return own;
}

void rods_flow(Elements& body, const VecX& x, double h) {
    RodElements& elements = static_cast<RodElements&>(body);
    const std::vector<RodStrain> before = rod_strains(elements, x);
    std::vector<Flow> flows;
    for (size_t s = 0; s < before.size(); ++s) {
        const Yield& yield = elements.yields[s];
        const double bend = fibre_strain(elements.segments[s], before[s]).bend;
        if (yield.strain == 0 || !(bend > yield.strain)) continue;
        Flow flow = {s, elements.segments[s].set_curvature, Vec3::Zero(), elements.hardening[s]};
        const double gone = 1 - elastic_share(yield, bend, h, flow.hardening);
        flow.curvature = gone * Vec3(0, before[s].curvature[1], before[s].curvature[2]);
        flows.push_back(flow);
    }
    for (double share = 1; share > LEAST_FLOW && !flows.empty(); share /= 2) {
        for (const Flow& flow : flows) give_set(elements.segments[flow.segment], flow.from + share * flow.curvature);
        const std::vector<RodStrain> after = rod_strains(elements, x);
        const auto gain = [&](const Flow& flow) {
            const RodSegment& rod = elements.segments[flow.segment];
            return segment_energy(rod, after[flow.segment]) - segment_energy(rod, before[flow.segment]);
        };
        double gained = 0;
        for (const Flow& flow : flows) gained += gain(flow);
        const auto dissipates = [&](const Flow& flow) {
            if (!(gained <= 0) && !(gain(flow) <= 0)) return false;
            double& hardening = elements.hardening[flow.segment];
            hardening += share * (flow.hardening - hardening);
            return true;
        };
        remove_where(flows, dissipates);
    }
    for (const Flow& flow : flows) give_set(elements.segments[flow.segment], flow.from);
}

std::vector<double> plastic_of_rods(const Elements& body) {
    std::vector<double> values;
    const RodElements& elements = as_rods(body);
    for (size_t s = 0; s < elements.hardening.size(); ++s) {
        const Vec3& set = elements.segments[s].set_curvature;
        values.insert(values.end(), {set[1], set[2], elements.hardening[s]});
    }
    return values;
}

void set_plastic_of_rods(Elements& body, const std::vector<double>& values) {
    RodElements& elements = static_cast<RodElements&>(body);
    if (values.size() != NUMBERS_OF_PIECE * elements.segments.size())
        fail(FROND_RESULT_BAD_ARGUMENT, "%zu numbers of a plastic state were given, but a plant of these rods has %zu",
             values.size(), NUMBERS_OF_PIECE * elements.segments.size());
    for (size_t s = 0; s < elements.segments.size(); ++s) {
        const double* v = values.data() + NUMBERS_OF_PIECE * s;
        if (!(v[2] >= 0))
            fail(FROND_RESULT_BAD_ARGUMENT, "the plastic state has a hardening of %g; it is never below 0", v[2]);
    }
    for (size_t s = 0; s < elements.segments.size(); ++s) {
        const double* v = values.data() + NUMBERS_OF_PIECE * s;
        give_set(elements.segments[s], {0, v[0], v[1]});
        elements.hardening[s] = v[2];
    }
}

}  // namespace frond
