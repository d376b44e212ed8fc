// In: a plant of tets that is solved but not yet accepted. Out: the same, with no capsule of a caged organ stretched
// more than its tissue would be.
//
// A fibre is slack up to a small stretch and beyond it as stiff as what the cage lacks, so small motions, the rest
// shape and the fit of the cage are unaffected. It only pulls. Taut fibres are rows of impulses against the plant's own
// factor, as contacts are, with their own compliance on the diagonal: for a step whose positions follow velocities by
// `reach`, an impulse p is a force p / reach, which stretches the fibre by p / (reach k). A grabbed vertex, and a
// node that a force of the host pulls, pull at their capsule likewise.
#include <algorithm>
#include <cmath>

#include "core/timer.hpp"
#include "plant/fibre_rows.hpp"
#include "plant/guard.hpp"
#include "plant/load_work.hpp"
#include "plant/plant.hpp"
#include "solve/node_compliance.hpp"
#include "solve/one_sided.hpp"

namespace frond {

namespace {

constexpr int ROUNDS = 3;        // one leaves 10 % at 5 N on a blade, three 3.5 %: pulls turn what they pull
constexpr double CLOSE = 0.001;  // error in stretch that needs no further round [-]
constexpr double LIFT = 0.001;   // error allowed in energies, over that which lifts the plant by its size [-]

// A row at the present positions: forces of a unit pull on its nodes, and its excess length [m].
struct NodePull {
    int node;
    Vec3 along;  // force on the node by a unit pull [-]
};
struct Stretch {
    std::vector<NodePull> pull;
    double over;
};

Stretch stretch_of(const FibreRow& row, const VecX& x) {
    const Vec3 way = attachment_place(row.end, x) - attachment_place(row.begin, x);
    const Vec3 along = way.normalized();
    Stretch stretch = {{}, way.norm() - row.length};
    const auto add = [&](const AttachmentDerivative& at, const Vec3& pull) {
        for (size_t k = 0; k < size_t(at.count); k++) stretch.pull.push_back({at.node[k], at.by[k].transpose() * pull});
    };
    add(derivative_at(row.end, x), -along);
    add(derivative_at(row.begin, x), along);
    return stretch;
}

std::vector<Stretch> stretches_of(const std::vector<FibreRow>& rows, const VecX& x) {
    std::vector<Stretch> stretches;
    for (const FibreRow& row : rows) stretches.push_back(stretch_of(row, x));
    return stretches;
}

// Returns how fast each row closes by pulls on every row [1/kg]; empty if that has no solution. A NodeCompliance has
// three directions, so it takes three rows.
Eigen::MatrixXd couple(Plant& plant, const std::vector<Stretch>& stretches) {
    const size_t count = stretches.size(), triples = (count + 2) / 3;
    std::vector<NodeCompliance> compliances(triples);
    std::vector<const NodeCompliance*> all;
    for (size_t t = 0; t < triples; t++) {
        std::vector<NodeBlock> pulls;
        for (size_t i = 3 * t; i < std::min(count, 3 * t + 3); i++)
            for (const NodePull& pull : stretches[i].pull) {
                pulls.push_back({pull.node, Mat3::Zero()});
                pulls.back().block.col(Eigen::Index(i % 3)) = pull.along;
            }
        if (!make_compliance(*plant.step.workspace, plant.input.settings, pulls, compliances[t])) return {};
        all.push_back(&compliances[t]);
    }
    Eigen::MatrixXd W(3 * triples, 3 * triples);
    Columns3 spread;
    std::vector<Mat3> blocks;
    for (size_t by = 0; by < triples; by++) {
        blocks.assign(triples, Mat3::Zero());
        add_compliances(all, compliances[by], spread, blocks);
        for (size_t t = 0; t < triples; t++) W.block<3, 3>(Eigen::Index(3 * t), Eigen::Index(3 * by)) = blocks[t];
    }
    W.conservativeResize(Eigen::Index(count), Eigen::Index(count));
    return W;
}

// Returns the impulses of pulls on all nodes.
VecX spread(const Plant& plant, const std::vector<Stretch>& stretches, const VecX& pulls) {
    VecX impulse = VecX::Zero(plant.state.motion.v.size());
    for (size_t i = 0; i < stretches.size(); i++)
        for (const NodePull& pull : stretches[i].pull) point(impulse, pull.node) += pulls[Eigen::Index(i)] * pull.along;
    return impulse;
}

// Finds the change of the plant's velocities by pulls. False if it has no solution.
bool velocity_by(Plant& plant, const std::vector<Stretch>& stretches, const VecX& pulls, VecX& dv) {
    return respond(*plant.step.workspace, plant.input.settings, spread(plant, stretches, pulls), dv);
}

// Stops the lengthening of rows that pull.
void stop_lengthening(Plant& plant, const std::vector<Stretch>& stretches, const Eigen::MatrixXd& W, VecX pulls) {
    std::vector<Eigen::Index> taut;
    VecX lengthening = VecX::Zero(pulls.size()), stops, dv;
    for (Eigen::Index i = 0; i < pulls.size(); i++) {
        if (pulls[i] > 0) taut.push_back(i);
        for (const NodePull& pull : stretches[size_t(i)].pull)
            lengthening[i] -= pull.along.dot(point(plant.state.motion.v, pull.node));
    }
    const Eigen::MatrixXd among_taut = W(taut, taut);
    const VecX of_taut = lengthening(taut);
    if (!solve_one_sided(among_taut, of_taut, stops)) return;
    pulls.setZero();
    for (size_t k = 0; k < taut.size(); k++) pulls[taut[k]] = stops[Eigen::Index(k)];
    if (velocity_by(plant, stretches, pulls, dv)) plant.state.motion.v += dv;
}

// Returns the work of loads and weight on the plant's way, but not of pins [J].
double work_of_loads_and_weight(const Plant& plant, const LoadWork& work) {
    return work.forces + work.grabs + work.air + work_of_weight(plant, way_of_step(plant));
}

// Goes only so far by pulls as the cage stores no more than where the solve left it, or where the step began and by the
// work of loads: between pins or grabs that are too far apart, the linear response of pulls crumples it more in each
// step.
void take_back_crumpling(Plant& plant, const VecX& x_free, const VecX& v_free, double h) {
    constexpr double LEAST = 0.1;  // share of the pulls that is tried [-]
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const auto stored_at = [&](const VecX& x) { return row.energy(elements_of(plant), x); };
    Motion& motion = plant.state.motion;
    const double free = stored_at(x_free);
    double stored = stored_at(motion.x);
    if (stored <= free) return;
    const VecX way = motion.x - x_free, dv = motion.v - v_free;
    const double before = stored_at(plant.step.x_good), error = LIFT * lifting_energy(plant);
    const auto may_be_stored = [&] {
        if (stored <= std::max(free, before) + error) return true;
        return stored <= before + work_of_loads_and_weight(plant, work_of_loads(plant, h)) + error;
    };
    double share = 1;
    while (share > 0 && !may_be_stored()) {
        share = share > LEAST ? share / 2 : 0;
        motion.x = x_free + share * way;
        motion.v = v_free + share * dv;
        stored = stored_at(motion.x);
    }
    plant.state.fibre_force *= share;
}

// Slows the plant down to what it had and was given on the way that is left: before the pulls, a force of the host drew
// its node much farther, and that work is still in the velocities.
void take_back_speed(Plant& plant, double h) {
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const auto kinetic_at = [&](const VecX& x, const VecX& v) { return kinetic_energy(*plant.system, x, v); };
    Motion& motion = plant.state.motion;
    const LoadWork work = work_of_loads(plant, h);
    const double given = work_of_loads_and_weight(plant, work) + work.pins + work.error + LIFT * lifting_energy(plant),
                 before = row.energy(elements_of(plant), plant.step.x_good) +
                          kinetic_at(plant.step.x_good, plant.step.v_good),
                 most = std::max(0.0, before + given - row.energy(elements_of(plant), motion.x)),
                 kinetic = kinetic_at(motion.x, motion.v);
    if (kinetic > most) motion.v *= std::sqrt(most / kinetic);
}

// Pulls are internal forces, so the integrator keeps its history: started anew by implicit Euler after each step with
// pulls, it would damp the vibration of a plant whose leaves are taut. Only the rates of generalized alpha at the
// step's end do not include them.
void go_on_from_here(Motion& motion, bool was_shaken) {
    History& history = motion.history;
    history.shaken = was_shaken;
    if (!history.valid) return;
    if (history.integrator == FROND_INTEGRATOR_GENERALIZED_ALPHA) {
        history.valid = history.shaken = false;
        return;
    }
    history.x_end = motion.x;
    history.v_end = motion.v;
}

}  // namespace

// Corrects positions first, in rounds, since pulls turn the fibres, which is of second order in the displacement.
// Velocities are corrected separately: where a fibre becomes taut, bdf2 would have it rebound, and faster in the next
// steps.
static void pull_back(Plant& plant, double h, bool is_step) {
    update_chain(plant);
    if (plant.state.is_entangled || !plant.state.fibre_give.empty()) let_fibres_give(plant, h);
    const std::vector<FibreRow> rows = find_fibre_rows(plant);
    if (rows.empty()) return;
    if (is_step) plant.step.unpulled = std::make_unique<LoadWork>(work_of_loads(plant, h));
    const Eigen::Index count = Eigen::Index(rows.size());
    const bool was_shaken = plant.state.motion.history.shaken;
    const double reach = reach_of(*plant.step.workspace);
    const VecX x_free = plant.state.motion.x, v_free = plant.state.motion.v;
    VecX pulls = VecX::Zero(count), softness(count), dv;  // impulses [N s]; a row's stretch by its impulse [m/(N s)]
    for (Eigen::Index i = 0; i < count; i++) softness[i] = 1 / (reach * rows[size_t(i)].stiffness);
    std::vector<Stretch> stretches = stretches_of(rows, plant.state.motion.x);
    Eigen::MatrixXd W;
    for (int round = 0; round < ROUNDS; round++) {
        W = couple(plant, stretches);
        if (W.size() == 0) return;
        const VecX known = pulls;
        VecX wanted = W * known;
        for (Eigen::Index i = 0; i < count; i++) wanted[i] += stretches[size_t(i)].over / reach;
        Eigen::MatrixXd soft = W;
        soft.diagonal() += softness / reach;
        if (!solve_one_sided(soft, wanted, pulls) || !velocity_by(plant, stretches, pulls - known, dv)) return;
        add_correction(*plant.step.workspace, dv, plant.state.motion);
        stretches = stretches_of(rows, plant.state.motion.x);
        double wrong = 0;
        for (size_t i = 0; i < rows.size(); i++) {
            const double drawn = softness[Eigen::Index(i)] * pulls[Eigen::Index(i)];
            wrong = std::max(wrong, (stretches[i].over - drawn) / rows[i].length);
        }
        if (wrong < CLOSE) break;
    }
    plant.state.fibre_force = spread(plant, stretches, pulls) / reach;
    stop_lengthening(plant, stretches, W, pulls);
    if (is_step) take_back_crumpling(plant, x_free, v_free, h);
    if (is_step && plant.input.has_user_force) take_back_speed(plant, h);
    go_on_from_here(plant.state.motion, was_shaken);
}

void hold_lengths(Plant& plant, double h, bool is_step) {
    plant.state.fibre_force.resize(0);
    plant.step.unpulled = nullptr;
    if (!plant.step.has_fibres || !plant.fibres || !plant.report.ok) return;
    const Timer timer;
    pull_back(plant, h, is_step);
    plant.ms_fibres += timer.ms();
    plant.report.ms_solve += timer.ms();
}

}  // namespace frond
