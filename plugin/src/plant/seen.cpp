// In: a plant before and after what is simulated of it changes. Out: how it looks until the change has blended out.
//
// Differences in shape are mostly turns, which displacements that decrease would draw out. So the chain blends from
// its turns before to those now, and takes the surface with it; only what turns cannot represent blends out as
// displacements, and so do the cage's nodes, which nobody sees. A plant whose mechanics move the cage has the chain
// that fits its surface.
#include "plant/seen.hpp"

#include "mechanics/rotation.hpp"

namespace frond {

Marks make_marks(const Model& model, std::shared_ptr<const Follow> follow) {
    constexpr size_t MOST = 1000;  // vertices
    const size_t count = model.surface.positions.size(), step = (count + MOST - 1) / MOST;
    Marks marks = {std::move(follow), {}, {}};
    for (size_t v = 0; v < count; v += step) marks.vertices.push_back(int(v));
    marks.points.modelled.resize(3 * Eigen::Index(marks.vertices.size()));
    for (size_t i = 0; i < marks.vertices.size(); i++) {
        const size_t v = size_t(marks.vertices[i]);
        point(marks.points.modelled, int(i)) = model.surface.positions[v];
        marks.points.attachments.push_back(skin_attachment(marks.follow->skin, marks.follow->skin.vertices[v]));
    }
    return marks;
}

// Returns what the points do where the cage's nodes are at x, or their velocities.
static VecX carried_by_cage(const Plant& plant, const Marks& marks, const VecX& x) {
    VecX places(marks.points.modelled.size());
    for (size_t i = 0; i < marks.vertices.size(); i++)
        point(places, int(i)) = bound_point(plant, plant.model->embedding, size_t(marks.vertices[i]), x);
    return places;
}

// Returns the positions and rotations of the chain where the mechanics' nodes are at x; those that fit a cage roughly
// change smoothly with it.
static VecX own_chain(const Plant& plant, const VecX& x) {
    if (plant.follow) return x;
    const Marks& marks = *marks_of(plant);
    VecX chain(6 * Eigen::Index(plant.model->chain.nodes.size()));
    fit_chain_roughly(marks.points, *plant.model, carried_by_cage(plant, marks, x), chain);
    return chain;
}

static Mat3 turn_at(const VecX& x, int node) {
    return rotation_of<double>(point(x, node + 1));
}

// Returns the rotation midway between those of two chain nodes.
static Mat3 midway(const VecX& x, int a, int b) {
    const Mat3 first = turn_at(x, a);
    return first * rotation_of<double>(0.5 * rotation_vector<double>(first.transpose() * turn_at(x, b)));
}

// Returns a chain whose nodes are turned in their frames; its segments keep their lengths.
static VecX turned(const Chain& chain, const VecX& x, const VecX& turns) {
    VecX to = x;
    for (int n = 0; n < int(x.size()) / 3; n += 2)
        point(to, n + 1) = rotation_vector<double>(turn_at(x, n) * turn_at(turns, n));
    for (int i = 0; i < int(chain.nodes.size()); i++) {
        const int begin = 2 * chain.nodes[size_t(i)].parent, end = 2 * i;
        if (begin < 0) continue;
        point(to, end) = point(to, begin) + midway(to, begin, end) *
                                                (midway(x, begin, end).transpose() * (point(x, end) - point(x, begin)));
    }
    return to;
}

// Returns the turns that take the rotations of one chain to those of another.
static VecX turns_between(const VecX& from, const VecX& to) {
    VecX turns = VecX::Zero(from.size());
    for (int n = 0; n < int(from.size()) / 3; n += 2)
        point(turns, n + 1) = rotation_vector<double>(turn_at(from, n).transpose() * turn_at(to, n));
    return turns;
}

static bool turns(const Plant& plant) {
    return blends(plant) && !is_over(plant.state.blend->turns);
}

// Returns the chain as it is seen, after a time.
static VecX seen_chain(const Plant& plant, const VecX& own, double after) {
    if (!turns(plant)) return own;
    VecX turns = VecX::Zero(own.size());
    add_offset(plant.state.blend->turns, turns, after);
    return turned(plant.model->chain, own, turns);
}

static VecX surface_of(const Plant& plant) {
    const Look look = look_of(plant, plant.state.motion.x, 0);
    VecX places(3 * Eigen::Index(plant.model->surface.positions.size()));
    for (size_t v = 0; v < plant.model->surface.positions.size(); v++)
        point(places, int(v)) = vertex_in(plant, look, v);
    return places;
}

Seen seen_of(const Plant& plant) {
    const Motion& motion = plant.state.motion;
    Seen seen = {cage_places(plant), cage_velocities(plant), surface_of(plant), {}, {}};
    if (plant.follow || blends(plant)) {
        seen.chain = seen_chain(plant, own_chain(plant, motion.x), 0);
        seen.chain_moving = seen_chain(plant, own_chain(plant, motion.x + SHORT * motion.v), SHORT);
        return seen;
    }
    // The chain that fits best. A rotation that few points determine follows them slowly.
    constexpr double SLOWLY = 0.01;
    const Marks& marks = *marks_of(plant);
    VecX rate;
    seen.chain.resize(6 * Eigen::Index(plant.model->chain.nodes.size()));
    fit_chain(marks.points, *plant.model, carried_by_cage(plant, marks, motion.x), seen.chain);
    fit_velocities(marks.points, seen.chain, carried_by_cage(plant, marks, motion.v), rate, SLOWLY);
    seen.chain_moving = seen.chain + SHORT * rate;
    return seen;
}

VecX chain_rate(const Seen& seen) {
    return (seen.chain_moving - seen.chain) / SHORT;
}

// Returns the difference of the cage nodes' velocities. What shakes faster than by the plant's size a second would go
// on by metres until it has blended out.
static VecX change_of_velocities(const Plant& plant, const Seen& seen) {
    constexpr double PER_SECOND = 1;  // [1/s]
    VecX change = seen.velocities - cage_velocities(plant);
    const double most = PER_SECOND * double(plant.size);
    for (int i = 0; i < int(change.size()) / 3; i++)
        if (const double speed = point(change, i).norm(); speed > most) point(change, i) *= most / speed;
    return change;
}

void blend_from(Plant& plant, const Seen& seen) {
    end_blend(plant);
    const Motion& motion = plant.state.motion;
    Blend& blend = *(plant.state.blend = std::make_unique<Blend>());
    const VecX turns = turns_between(own_chain(plant, motion.x), seen.chain);
    const VecX later = turns_between(own_chain(plant, motion.x + SHORT * motion.v), seen.chain_moving);
    begin_blend_out(blend.turns, turns, (wound_as(turns, later) - turns) / SHORT);
    begin_blend_out(blend.nodes, seen.places - cage_places(plant), change_of_velocities(plant, seen));
    const VecX left = seen.surface - surface_of(plant);
    begin_blend_out(blend.surface, left, VecX::Zero(left.size()));
    plant.view.cage_stale = plant.view.surface_stale = true;
}

void end_blend(Plant& plant) {
    plant.state.blend = nullptr;
    plant.view.cage_stale = plant.view.surface_stale = true;
}

void pass_blend_time(Plant& plant, double h) {
    if (!blends(plant)) return;
    Blend& blend = *plant.state.blend;
    for (BlendOut* part : {&blend.turns, &blend.surface, &blend.nodes}) pass_time(*part, h);
    if (is_over(blend.turns) && is_over(blend.surface) && is_over(blend.nodes)) end_blend(plant);
}

Look look_of(const Plant& plant, const VecX& x, double after) {
    Look look;
    (plant.follow ? look.chain : look.cage) = x;
    if (turns(plant)) {
        const VecX own = own_chain(plant, x);
        look.chain = seen_chain(plant, own, after);
        if (!plant.follow) look.own = own;
    }
    if (blends(plant) && !is_over(plant.state.blend->surface)) {
        look.left.setZero(3 * Eigen::Index(plant.model->surface.positions.size()));
        add_offset(plant.state.blend->surface, look.left, after);
    }
    return look;
}

Vec3 vertex_in(const Plant& plant, const Look& look, size_t vertex) {
    Vec3 place = Vec3::Zero();
    if (look.cage.size() > 0) place += bound_point(plant, plant.model->embedding, vertex, look.cage);
    if (look.chain.size() > 0) {
        const Skin& skin = (plant.follow ? plant.follow : marks_of(plant)->follow)->skin;
        const Attachment attachment = skin_attachment(skin, skin.vertices[vertex]);
        place += attachment_place(attachment, look.chain);
        if (look.own.size() > 0) place -= attachment_place(attachment, look.own);
    }
    if (look.left.size() > 0) place += point(look.left, int(vertex));
    return place;
}

}  // namespace frond
