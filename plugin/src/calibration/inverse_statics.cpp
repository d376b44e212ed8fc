// In: a cage as modelled, a share of gravity. Out: its shape without gravity, or what keeps it from having one.
#include "calibration/inverse_statics.hpp"

#include <algorithm>

#include "calibration/firm_tets.hpp"
#include "calibration/toppling.hpp"
#include "core/elementary.hpp"

namespace frond {
namespace {

// Returns whether a tet whose rest positions are moved keeps, at each of its points, more than a third of its volume as
// modelled, and is not overstretched.
template <class Element>
bool is_sound(const TetElements& elements, size_t e, const VecX& moved) {
    constexpr double LONGEST = 10;  // length of an edge over that in the modelled shape [-]
    const auto now = Element::places(elements, e, moved), before = Element::places(elements, e, elements.modelled);
    for (int q = 0; q < Element::POINTS; q++) {
        const Mat3 a = Element::edges(now, q), b = Element::edges(before, q);
        if (!(a.determinant() / b.determinant() > 1.0 / 3) ||
            !(a.colwise().norm().maxCoeff() < LONGEST * b.colwise().norm().maxCoeff()))
            return false;
    }
    return true;
}

// Returns the largest share of a displacement of the rest shape that leaves every tet sound, since a flat tet or a
// needle has no inverse. Returns 0 if none does; `torn` is then the organ that weight tears.
double longest_move(const Model& model, const TetElements& elements, const VecX& move, int& torn) {
    for (double share = 1; share > 0.01; share /= 2) {
        const VecX moved = elements.rest_positions + share * move;
        bool good = moved.allFinite();
        for (size_t e = 0; e < elements.tets.size() && good; e++) {
            good = elements.nodes.order == 1 ? is_sound<LinearTet>(elements, e, moved)
                                             : is_sound<QuadraticTetElement>(elements, e, moved);
            if (!good) torn = model.cage.tet_organ[e];
        }
        if (good) return share;
    }
    return 0;
}

// Returns the organ of the node that moves farthest; -1 if none moves.
int organ_of_largest(const Model& model, const TetElements& elements, const VecX& move) {
    int node = 0;
    for (int i = 1; i < move.size() / 3; i++)
        if (point(move, i).squaredNorm() > point(move, node).squaredNorm()) node = i;
    if (point(move, node).isZero(0)) return -1;
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        const ElementNodes nodes = element_nodes(elements, e);
        if (std::find(nodes.node, nodes.node + nodes.count, node) != nodes.node + nodes.count)
            return model.cage.tet_organ[e];
    }
    return -1;
}

// Copies one organ's tets, with their slots in the pattern of all elements.
TetElements take_organ(const TetElements& all, const std::vector<int>& tet_organ, int organ) {
    TetElements one;
    one.node_count = all.node_count;
    one.nodes.order = all.nodes.order;
    const size_t points = all.rest_inverse.size() / all.tets.size();
    const auto take = [&](const auto& from, auto& to, size_t e, size_t count = 1) {
        if (!from.empty()) to.insert(to.end(), from.begin() + long(e * count), from.begin() + long((e + 1) * count));
    };
    for (size_t e = 0; e < all.tets.size(); e++) {
        if (tet_organ[e] != organ) continue;
        take(all.tets, one.tets, e);
        take(all.ordered, one.ordered, e);
        take(all.nodes.of_tet, one.nodes.of_tet, e);
        take(all.rest_inverse, one.rest_inverse, e, points);
        take(all.point_volume, one.point_volume, e, points);
        take(all.volume, one.volume, e);
        take(all.lambda, one.lambda, e);
        take(all.mu, one.mu, e);
        take(all.grain, one.grain, e);
        take(all.grain_modelled, one.grain_modelled, e);
        take(all.grain_axis, one.grain_axis, e, points);
        take(all.slots, one.slots, e);
        take(all.quadratic_slots, one.quadratic_slots, e);
    }
    return one;
}

// Adds move' K move with each organ's own stiffness K.
void add_work_of_tets(const RestSearch& search, const TetElements& elements, const VecX& move,
                      std::vector<double>& work) {
    const std::vector<int>& tet_organ = search.model.cage.tet_organ;
    std::vector<uint8_t> has_tets(work.size(), 0);
    for (const int organ : tet_organ) has_tets[size_t(organ)] = 1;
    BlockMatrix own;
    own.set_pattern(elements.pattern);
    VecX product;
    for (size_t organ = 0; organ < work.size(); organ++) {
        if (!has_tets[organ]) continue;
        own.set_zero();
        search.row.add_stiffness(take_organ(elements, tet_organ, int(organ)), search.x, Tangent::positive, 1, own);
        own.multiply(move, product);
        work[organ] += move.dot(product);
    }
}

// Scales the moduli of each organ's tets.
void scale_organs(const std::vector<int>& tet_organ, const std::vector<double>& factors, TetElements& elements) {
    for (size_t e = 0; e < elements.tets.size(); e++) {
        elements.mu[e] *= factors[size_t(tet_organ[e])];
        elements.lambda[e] *= factors[size_t(tet_organ[e])];
    }
}

// Finds how a plant whose organs are softer by their margins topples, and which of them give way. All are softened by
// the largest margin, by which weight is then too much, so those with less become stiffer.
RestOutcome find_outcome(RestSearch& search, const std::vector<double>& margins) {
    BlockMatrix taken;
    taken.set_pattern(search.elements.pattern);
    take_by_weight(search.elements, search.row, search.x, taken);
    const double largest = *std::max_element(margins.begin(), margins.end());
    std::vector<double> factors;
    for (const double margin : margins) factors.push_back(largest / margin);
    TetElements elements = search.elements;
    scale_organs(search.model.cage.tet_organ, factors, elements);
    if (!search.stiffness.set(elements, search.held, search.row, Tangent::positive, search.x)) return {};
    const Toppling toppling = find_toppling(search.stiffness, taken, search.held);
    if (toppling.mode.size() == 0) return {};
    RestOutcome outcome;
    outcome.overload = largest * toppling.overload;
    outcome.shares = find_shares(
        toppling, search.stiffness, taken, search.held, search.model.organs.size(),
        [&](const VecX& move, std::vector<double>& work) { add_work_of_tets(search, elements, move, work); });
    return outcome;
}

}  // namespace

RestSearch::RestSearch(const Model& model, frond_mechanics which, int order)
    : model(model),
      which(which),
      row(mechanics(which, order)),
      elements(make_tet_elements(model, nullptr, order)),
      held(with_middles(elements.nodes, find_held_nodes(model.cage, model.root))),
      x(elements.modelled),
      rest(x),
      stiffness(elements.pattern),
      system(elements, held) {}

void RestSearch::move_to(const VecX& moved) {
    rest = moved;
    set_rest_positions(elements, rest);
}

void RestSearch::stiffen(const VecX& change) {
    for (size_t e = 0; e < elements.tets.size(); e++) {
        const double factor = frond::exp(change[Eigen::Index(e)]);
        elements.mu[e] *= factor;
        elements.lambda[e] *= factor;
    }
}

bool balance(RestSearch& search, double gravity) {
    constexpr int ROUNDS = 25;           // Newton's method takes 5 or 6 where it converges
    constexpr double TOLERANCE = 3e-9;   // distance of a node from its balance, over the plant's size [-]
    constexpr double LEAST_SHARE = 0.1;  // least share of a displacement that makes progress [-]
    constexpr int PATIENCE = 5;          // rounds in which displacements must become half as large
    const VecX start = search.rest;
    std::vector<double> sizes;
    VecX move = VecX::Zero(search.x.size());
    for (int round = 0; round < ROUNDS; round++) {
        const VecX force = unbalanced_force(search.elements, search.held, search.which, search.x, gravity);
        if (!search.system.find_move(search.elements, search.which, search.x, gravity, force, move)) break;
        const double share = longest_move(search.model, search.elements, move, search.torn);
        if (share < LEAST_SHARE) {
            search.move_to(start);
            return false;
        }
        search.move_to(search.rest + share * move);
        sizes.push_back(move.lpNorm<Eigen::Infinity>());
        if (share == 1 && sizes.back() < TOLERANCE * search.model.surface.size()) return true;
        if (round >= 2 * PATIENCE && !(sizes.back() < 0.5 * sizes[size_t(round - PATIENCE)])) break;
    }
    search.torn = organ_of_largest(search.model, search.elements, move);
    search.move_to(start);
    return false;
}

RestOutcome search_rest_shape(RestSearch& search, const std::vector<double>& margins) {
    constexpr double SMALLEST_STEP = 1.0 / 8;  // share of gravity below which the search gives up [-]
    double step = 1;
    for (double done = 0; done < 1;) {
        const double next = std::min(1.0, done + step);
        if (balance(search, GRAVITY * next)) {
            done = next;
            step *= 2;
        } else {
            step = 0.25 * (next - done);
            if (step < SMALLEST_STEP) return {VecX(), {}, 1, search.torn};
        }
    }
    const bool stands = search.stiffness.set(search.elements, search.held, search.row, Tangent::exact, search.x);
    const bool as_it_is = std::all_of(margins.begin(), margins.end(), [](double margin) { return margin == 1; });
    if (stands && as_it_is) return {search.rest, {}, 1, -1};
    RestOutcome outcome = find_outcome(search, margins);
    if (stands && !(outcome.overload > 1)) outcome = {search.rest, {}, 1, -1};
    return outcome;
}

}  // namespace frond
