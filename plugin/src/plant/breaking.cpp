// In: a plant and a capsule of its chain. Out: the plant without the part beyond that capsule, and that part as a rigid
// body.
//
// Elements of the capsules that are gone leave the plant's system, together with their mass. Nodes keep their places in
// all arrays, so that a plant's state keeps its layout, and are held. Cage nodes and vertices go with the tets they are
// in, tets with the capsule that they belong to.
#include "core/decompose.hpp"
#include "plant/fragment.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "mechanics/rotation.hpp"
#include "mechanics/sections.hpp"
#include "plant/plant.hpp"

namespace frond {

namespace {

// Marks the chain nodes beyond a broken capsule that are not in another fragment already.
void mark_chain(const Plant& plant, int node, int fragment, std::vector<int>& of_chain) {
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    of_chain.resize(nodes.size(), -1);
    for (size_t i = size_t(node); i < nodes.size(); i++) {
        const int parent = nodes[i].parent;
        const bool beyond = int(i) == node || (parent >= node && of_chain[size_t(parent)] == fragment);
        if (beyond && of_chain[i] < 0) of_chain[i] = fragment;
    }
}

void mark_cage(const Plant& plant, Parting& parting) {
    const Model& model = *plant.model;
    const std::vector<int> capsule = capsules_of_tets(model);
    parting.of_tet.clear();
    for (int c : capsule) parting.of_tet.push_back(parting.of_chain[size_t(c)]);
    constexpr int NONE = -2;  // no tet has been there; -1: the plant itself
    parting.of_node.assign(plant.input.pinned.size(), NONE);
    const auto mark = [&](int node, int fragment) {
        int& of = parting.of_node[size_t(node)];
        of = of == NONE ? fragment : std::min(of, fragment);
    };
    for (size_t e = 0; e < capsule.size(); e++) {
        for (int corner : model.cage.tets[e]) mark(corner, parting.of_tet[e]);
        if (plant.nodes->order == 2)
            for (int node : plant.nodes->of_tet[e]) mark(node, parting.of_tet[e]);
    }
    for (int& of : parting.of_node) of = std::max(of, -1);
}

void mark_surface(const Plant& plant, Parting& parting) {
    const Model& model = *plant.model;
    parting.of_vertex.clear();
    for (int tet : model.embedding.tet) parting.of_vertex.push_back(parting.of_tet[size_t(tet)]);
    parting.triangles = model.surface.triangles;
    for (Triangle& t : parting.triangles) {
        const int of = parting.of_vertex[size_t(t[0])];
        if (parting.of_vertex[size_t(t[1])] != of || parting.of_vertex[size_t(t[2])] != of) t[1] = t[2] = t[0];
    }
}

// Returns the rotation of the fragment's cage nodes against the modelled shape.
Mat3 turn_of(const Plant& plant, int number) {
    std::vector<Vec3> from, to;
    for (size_t i = 0; i < plant.state.parting->of_node.size(); i++) {
        if (plant.state.parting->of_node[i] != number) continue;
        from.push_back(point(plant.nodes->modelled, int(i)));
        to.push_back(point(plant.state.fragments[size_t(number)].cage_x, int(i)));
    }
    Mat3 turn;
    Vec3 image;
    return fit_rigid(from, to, Vec3::Zero(), turn, image) ? turn : Mat3(Mat3::Identity());
}

// Finds principal axes and moments of inertia in the modelled shape, so that they are the same for every plant of a
// model, and turns them with the fragment. The inertia of a ball with the stem's radius at the break is added.
void set_inertia(const Plant& plant, const VecX& mass, Fragment& fragment) {
    const VecX& modelled = elements_of(*plant.system).modelled;
    const int step = plant.follow ? 2 : 1;
    const double radius = plant.model->chain.nodes[size_t(fragment.node)].radius;
    Vec3 centre = Vec3::Zero();
    for (int i = 0; i < mass.size(); i += step) centre += mass[i] / fragment.mass * point(modelled, i);
    Mat3 inertia = 0.4 * fragment.mass * radius * radius * Mat3::Identity();
    for (int i = 0; i < mass.size(); i += step) {
        const Vec3 arm = point(modelled, i) - centre;
        inertia += mass[i] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    const SymmetricParts principal = symmetric_parts(inertia);
    Mat3 axes = principal.vectors;
    if (axes.determinant() < 0) axes.col(2) *= -1;
    fragment.axes = plant.rotation.toRotationMatrix() * turn_of(plant, int(plant.state.fragments.size()) - 1) * axes;
    fragment.moments = principal.values;
}

// Finds mass, centre and motion of the mass that left the nodes.
void measure(const Plant& plant, const VecX& mass, Fragment& fragment) {
    const int step = plant.follow ? 2 : 1;
    const auto place = [&](int i) { return plant.to_world(point(plant.state.motion.x, i)); };
    const auto velocity = [&](int i) { return Vec3(plant.rotation * point(plant.state.motion.v, i)); };
    Vec3 momentum = Vec3::Zero(), moment = Vec3::Zero();
    fragment.mass = 0;
    for (int i = 0; i < mass.size(); i += step) {
        fragment.mass += mass[i];
        moment += mass[i] * place(i);
        momentum += mass[i] * velocity(i);
    }
    if (!(fragment.mass > 0)) {
        // The fragment is too small to have mass in the cage.
        constexpr double LEAST = 1e-6;  // [kg]
        fragment.mass = LEAST;
        moment = LEAST * plant.to_world(plant.view.chain_positions[size_t(fragment.node)]);
    }
    FROND_ASSERT(fragment.mass > 0);
    fragment.centre = moment / fragment.mass;
    fragment.velocity = momentum / fragment.mass;
    Vec3 angular = Vec3::Zero();
    for (int i = 0; i < mass.size(); i += step)
        angular += mass[i] * (place(i) - fragment.centre).cross(velocity(i) - fragment.velocity);
    set_inertia(plant, mass, fragment);
    fragment.angular_velocity = fragment.axes * (fragment.axes.transpose() * angular).cwiseQuotient(fragment.moments);
}

// Puts nodes that no element holds any more to rest where they are.
void let_rest(Plant& plant) {
    Motion& motion = plant.state.motion;
    for (size_t i = 0; i < plant.state.parting->of_node.size(); i++)
        if (plant.state.parting->of_node[i] >= 0) plant.input.pinned[i] = 0;
    drop_lost_supports(plant);
    const VecX& mass = node_mass_of(*plant.system);
    const int step = plant.follow ? 2 : 1;
    for (int i = 0; i < mass.size(); i += step)
        for (int k = 0; k < step && !(mass[i] > 0); k++) point(motion.v, i + k).setZero();
    motion.history.valid = false;
    plant.input.pins_changed = true;
}

const Fragment* fragment_at(const Plant& plant, const std::vector<int>& list, size_t i) {
    return list.empty() || list[i] < 0 ? nullptr : &plant.state.fragments[size_t(list[i])];
}

}  // namespace

std::shared_ptr<Parting> no_parting() {
    static const std::shared_ptr<Parting> none = std::make_shared<Parting>();
    return none;
}

int find_break(const Plant& plant) {
    return find_overload(mechanics(plant.which, plant.nodes->order), elements_of(plant), plant.state.motion.x);
}

static std::vector<uint8_t> gone_with(const Plant& plant, size_t count) {
    std::vector<uint8_t> gone;
    for (int fragment : plant.state.parting->of_chain) gone.push_back(fragment >= 0 && fragment < int(count));
    return gone;
}

std::shared_ptr<const System> without_fragments(const Plant& plant, const System& system, size_t count) {
    return system_without(system, gone_with(plant, count));
}

// Takes the elements of all fragments out of the plant's system.
static void take_away(Plant& plant) {
    const std::vector<uint8_t> gone = gone_with(plant, plant.state.fragments.size());
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    std::unique_ptr<Elements> own = plant.state.own_elements ? row.without(*plant.state.own_elements, gone) : nullptr;
    plant.system = system_without(*plant.system, gone);
    plant.step.workspace = nullptr;
    plant.seat.leave();
    plant.seat.pool = std::make_shared<WorkspacePool>();
    plant.seat.take();
    plant.state.own_elements = std::move(own);
    plant.state.parting->start = plant.state.motion.x;
}

void leave_fragments(Plant& plant) {
    if (plant.state.fragments.empty()) return;
    take_away(plant);
    let_rest(plant);
}

void rejoin(Plant& plant, size_t count) {
    FROND_ASSERT(count < plant.state.fragments.size());
    plant.state.fragments.erase(plant.state.fragments.begin() + std::ptrdiff_t(count), plant.state.fragments.end());
    Parting& parting = *plant.state.parting;
    for (int& of : parting.of_chain)
        if (of >= int(count)) of = -1;
    mark_cage(plant, parting);
    mark_surface(plant, parting);
    if (count == 0) plant.state.parting = no_parting();
    take_mechanics(plant, plant.which);
    leave_fragments(plant);
}

// Returns where the nodes of a part are once it has sprung back: nothing holds it strained any more. That is one long
// step of implicit Euler from rest, searched to balance, which leaves its centre and hardly turns it.
static VecX sprung_back(const Plant& plant, int fragment) {
    constexpr double LONG = 1;      // longer than what comes off sways [s]
    constexpr int ITERATIONS = 30;  // of Newton's method at most
    std::vector<uint8_t> others;
    for (int of : plant.state.parting->of_chain) others.push_back(of != fragment);
    const Mechanics& row = mechanics(plant.which, plant.nodes->order);
    const std::unique_ptr<Elements> own =
        plant.state.own_elements ? row.without(*plant.state.own_elements, others) : nullptr;
    const WorkspacePtr workspace = make_workspace(system_without(*plant.system, others));
    use_elements(*workspace, own.get());
    SolveSettings settings = plant.input.settings;
    settings.integrator = FROND_INTEGRATOR_IMPLICIT_EULER;
    settings.newton_iterations = ITERATIONS;
    settings.careful = true;
    settings.mass_damping = settings.stiffness_damping = settings.full_damping = 0;
    Motion motion;
    motion.x = motion.pin_target = plant.state.motion.x;
    motion.v = VecX::Zero(motion.x.size());
    motion.pinned.assign(plant.state.motion.pinned.size(), 0);
    const bool ok = solve_step(*workspace, settings, Loads(), LONG, motion).ok;
    return ok && are_finite(motion.x) ? motion.x : plant.state.motion.x;
}

// Sets the shape that the part keeps from now on.
static void set_shape(const Plant& plant, const VecX& x, Fragment& fragment) {
    fragment.follow = plant.follow;
    fragment.chain_x.resize(plant.view.chain_positions.size());
    if (plant.follow) {
        fragment.x = x;
        follow_places(*plant.follow, x, fragment.cage_x);
    } else {
        fragment.cage_x = x;
    }
    for (size_t i = 0; i < fragment.chain_x.size(); i++)
        fragment.chain_x[i] =
            plant.follow ? Vec3(point(x, int(2 * i))) : attachment_place(chain_attachment(plant, int(i)), x);
}

const Fragment& break_off(Plant& plant, int node) {
    FROND_ASSERT(node >= 0 && plant.model->chain.nodes[size_t(node)].parent >= 0);
    Fragment fragment;
    fragment.node = node;
    fragment.turn = plant.rotation.toRotationMatrix();
    fragment.shift = plant.position;
    const VecX mass = node_mass_of(*plant.system);
    const int number = int(plant.state.fragments.size());
    if (plant.state.fragments.empty()) plant.state.parting = std::make_shared<Parting>();
    mark_chain(plant, node, number, plant.state.parting->of_chain);
    mark_cage(plant, *plant.state.parting);
    mark_surface(plant, *plant.state.parting);
    set_shape(plant, sprung_back(plant, number), fragment);
    plant.state.fragments.push_back(std::move(fragment));
    take_away(plant);
    measure(plant, mass - node_mass_of(*plant.system), plant.state.fragments.back());
    let_rest(plant);
    moved(plant);
    return plant.state.fragments.back();
}

// Moves nodes that are gone rigidly with the stump, the last node before them that is not gone.
void carry_stumps(Plant& plant) {
    if (!plant.follow || plant.state.fragments.empty()) return;
    const std::vector<ChainNode>& nodes = plant.model->chain.nodes;
    const VecX& start = plant.state.parting->start;
    Motion& motion = plant.state.motion;
    // A method with a history must not take this for a push.
    History& history = motion.history;
    const bool follows = history.valid && history.x_end.size() == motion.x.size();
    std::vector<int> stump(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); i++) {
        if (plant.state.parting->of_chain[i] < 0) continue;
        const int parent = nodes[i].parent, node = int(2 * i);
        stump[i] = plant.state.parting->of_chain[size_t(parent)] < 0 ? parent : stump[size_t(parent)];
        const int at = 2 * stump[i];
        const Mat3 turn =
            rotation_of<double>(point(motion.x, at + 1)) * rotation_of<double>(point(start, at + 1)).transpose();
        point(motion.x, node) = point(motion.x, at) + turn * (point(start, node) - point(start, at));
        point(motion.x, node + 1) = rotation_vector<double>(Mat3(turn * rotation_of<double>(point(start, node + 1))));
        for (int k = node; k < node + 2; k++) {
            point(motion.v, k).setZero();
            if (!follows) continue;
            point(history.x_end, k) = point(motion.x, k);
            point(history.v_end, k).setZero();
        }
    }
}

const Fragment* fragment_of_vertex(const Plant& plant, size_t vertex) {
    return fragment_at(plant, plant.state.parting->of_vertex, vertex);
}
const Fragment* fragment_of_chain_node(const Plant& plant, size_t node) {
    return fragment_at(plant, plant.state.parting->of_chain, node);
}
const Fragment* fragment_of_node(const Plant& plant, size_t node) {
    return fragment_at(plant, plant.state.parting->of_node, node);
}

}  // namespace frond
