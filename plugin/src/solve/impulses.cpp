// In: contacts and their coupling. Out: impulses, by projected Gauss-Seidel: contact by contact the normal and then the
// tangential impulse is corrected by the velocity's error and projected onto the admissible set (Moreau 1988, Jean
// 1999, "The non-smooth contact dynamics method"). Between rounds all impulses are extrapolated along the accumulated
// direction by the ratio of the gradients (Silcowitz-Hansen, Niebe, Erleben 2010, "A nonsmooth nonlinear conjugate
// gradient method for interactive contact force problems").
#include "solve/impulses.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/assert.hpp"
#include "core/decompose.hpp"

namespace frond {

namespace {

// Compliance of a contact to its own impulse, computed when it first pushes.
struct Own {
    Mat3 block = Mat3::Zero();
    double along = 0, across = 0;  // impulse by velocity error, along the normal and tangential [kg]
    Mat3 inverse = Mat3::Zero();   // the same for a bond
};

}  // namespace

Mat3 firm_inverse(const Mat3& block) {
    const SymmetricParts ways = symmetric_parts(0.5 * (block + block.transpose()));
    Vec3 inverse = Vec3::Zero();
    for (int i = 0; i < 3; i++)
        if (ways.values[i] > std::max(IMMOVABLE, 1e-9 * ways.values[2])) inverse[i] = 1 / ways.values[i];
    return ways.vectors * inverse.asDiagonal() * ways.vectors.transpose();
}

namespace {

struct Change {
    double largest = 0, most = 0;  // largest impulse, and largest change of one [N s]
    double speed = 0;              // largest change of a contact's velocity by its own impulse [m/s]
};

// One island: its contacts, numbered in a row.
struct ImpulseSearch {
    const std::vector<Touch>& touches;
    const CouplingTable& coupling;
    const std::vector<int>& island;
    std::vector<int>& place;  // index of a contact in its island
    VecX impulses, velocities;
    std::vector<std::unique_ptr<Own>> own;  // only for contacts that push or did
};

const Own& own_of(ImpulseSearch& search, int k) {
    std::unique_ptr<Own>& own = search.own[size_t(k)];
    if (own) return *own;
    own = std::make_unique<Own>();
    for (const Coupling& c : search.coupling.row(search.island[size_t(k)]))
        if (c.other == search.island[size_t(k)]) own->block += c.block;
    const Touch& touch = search.touches[size_t(search.island[size_t(k)])];
    if (touch.is_bond) {
        own->inverse = firm_inverse(own->block);
        return *own;
    }
    const double along = touch.normal.dot(own->block * touch.normal);
    const Mat3 flat = Mat3::Identity() - touch.normal * touch.normal.transpose();
    const double across = symmetric_values(flat * own->block * flat)[2];
    own->along = along > IMMOVABLE ? 1 / along : 0;
    own->across = across > IMMOVABLE ? 1 / across : 0;
    return *own;
}

void add_impulse(ImpulseSearch& search, int k, const Vec3& change) {
    search.impulses.segment<3>(3 * k) += change;
    for (const Coupling& c : search.coupling.row(search.island[size_t(k)]))
        search.velocities.segment<3>(3 * search.place[size_t(c.other)]) += c.block.transpose() * change;
}

// Returns a push along the normal plus a tangential impulse, limited by friction.
Vec3 in_cone(const Touch& touch, double push, Vec3 hold) {
    const double most = touch.friction * push, size = hold.norm();
    if (size > most) hold *= most / size;
    return push * touch.normal + hold;
}

// Returns the impulse of one contact in place of `before`, with all others as they are.
Vec3 corrected(const Touch& touch, const Own& own, Vec3 velocity, const Vec3& before) {
    if (touch.is_bond) return before + own.inverse * (touch.wanted - velocity);

    // Along the normal, push but never pull.
    const double push_before = before.dot(touch.normal);
    const double lacking = touch.bias_velocity - velocity.dot(touch.normal);
    const double push = own.along > 0 ? std::clamp(push_before + own.along * lacking, 0.0, touch.most_push) : 0;

    // Tangentially, oppose the sliding that is left, as far as friction can.
    velocity += own.block * ((push - push_before) * touch.normal);
    const Vec3 sliding = velocity - velocity.dot(touch.normal) * touch.normal;
    return in_cone(touch, push, before - push_before * touch.normal - own.across * sliding);
}

// Does a round over the contacts. Changes up to `unfelt` are not passed on to the other contacts, which are many.
Change sweep(ImpulseSearch& search, double unfelt) {
    Change change;
    for (int k = 0; k < int(search.island.size()); k++) {
        const Touch& touch = search.touches[size_t(search.island[size_t(k)])];
        const Vec3 before = search.impulses.segment<3>(3 * k), velocity = search.velocities.segment<3>(3 * k);
        const bool waits = !touch.is_bond && before.isZero(0) && velocity.dot(touch.normal) >= touch.bias_velocity;
        if (waits) continue;
        const Own& own = own_of(search, k);
        const Vec3 by = corrected(touch, own, velocity, before) - before;
        const double speed = (own.block * by).norm();
        change.largest = std::max(change.largest, (before + by).norm());
        if (speed <= unfelt) continue;
        add_impulse(search, k, by);
        change.most = std::max(change.most, by.norm());
        change.speed = std::max(change.speed, speed);
    }
    return change;
}

// Rounds take energy from what touches, relative to the velocities that contacts ask for, so whatever they end with
// takes some if they begin with none given. Impulses of the last step, and extrapolated ones, may give it: then only as
// much of them is kept as takes most.
void keep_what_takes_energy(ImpulseSearch& search) {
    double work = 0, square = 0;  // of all impulses p: p (v - asked) without them, and p W p [J]
    for (size_t k = 0; k < search.island.size(); k++) {
        const Touch& touch = search.touches[size_t(search.island[k])];
        const Vec3 asked = touch.is_bond ? touch.wanted : Vec3(touch.bias_velocity * touch.normal);
        const Vec3 impulse = search.impulses.segment<3>(3 * Eigen::Index(k));
        work += impulse.dot(touch.velocity - asked);
        square += impulse.dot(search.velocities.segment<3>(3 * Eigen::Index(k)) - touch.velocity);
    }
    if (work + 0.5 * square <= 0) return;
    const double share = work < 0 ? -work / square : 0;
    search.impulses *= share;
    for (size_t k = 0; k < search.island.size(); k++) {
        const Vec3& velocity = search.touches[size_t(search.island[k])].velocity;
        auto now = search.velocities.segment<3>(3 * Eigen::Index(k));
        now = velocity + share * (now - velocity);
    }
}

// Returns how many rounds an island may take. Its cost grows with the square of its contacts: rounds over many of them
// end early, and the next step, which begins with their impulses, goes on.
int most_rounds(size_t contacts, const ImpulseLimits& limits) {
    constexpr double MOST_COUPLINGS = 5e7, FEWEST = 10;  // passed on in all rounds, some tenths of a second; rounds
    const double all = double(contacts) * double(contacts);
    return int(std::min(double(limits.iterations), std::max(FEWEST, MOST_COUPLINGS / all)));
}

// Does rounds until nothing changes.
int solve_island(ImpulseSearch& search, const ImpulseLimits& limits, double unfelt, bool& converged) {
    const int most = most_rounds(search.island.size(), limits);
    VecX way = VecX::Zero(search.impulses.size()), way_faster = way, from, from_velocities;
    double last = 0;  // squared norm of the last round's change
    for (int iteration = 1;; iteration++) {
        from = search.impulses;
        from_velocities = search.velocities;
        const Change change = sweep(search, unfelt);
        converged = change.most <= limits.tolerance * change.largest || change.speed <= unfelt;
        if (converged || iteration >= most) return iteration;
        from = search.impulses - from;
        from_velocities = search.velocities - from_velocities;
        // Extrapolates along the accumulated direction, unless changes grow.
        const double square = from.squaredNorm(), share = last > 0 && square <= last ? square / last : 0;
        last = square;
        way *= share;
        way_faster *= share;
        search.impulses += way;
        search.velocities += way_faster;
        way += from;
        way_faster += from_velocities;
    }
}

}  // namespace

ImpulseReport find_impulses(const std::vector<Touch>& touches, const CouplingTable& coupling,
                            const ImpulseLimits& limits, std::vector<Vec3>& impulses, double unfelt) {
    impulses.resize(touches.size(), Vec3::Zero());
    FROND_ASSERT(std::all_of(touches.begin(), touches.end(), [](const Touch& touch) {
        return touch.is_bond || (touch.friction >= 0 && std::abs(touch.normal.squaredNorm() - 1) < 1e-5);
    }));
    std::vector<int> place(touches.size(), 0);
    ImpulseReport report;
    report.converged = true;
    for (const std::vector<int>& island : coupling.islands) {
        const Eigen::Index size = 3 * Eigen::Index(island.size());
        ImpulseSearch search = {touches, coupling, island, place, VecX::Zero(size), VecX(size), {}};
        search.own.resize(island.size());
        for (size_t k = 0; k < island.size(); k++) {
            place[size_t(island[k])] = int(k);
            FROND_ASSERT(island[k] >= 0 && size_t(island[k]) < touches.size());
            search.velocities.segment<3>(3 * Eigen::Index(k)) = touches[size_t(island[k])].velocity;
        }
        for (size_t k = 0; k < island.size(); k++)
            if (!impulses[size_t(island[k])].isZero(0)) add_impulse(search, int(k), impulses[size_t(island[k])]);
        keep_what_takes_energy(search);
        bool converged = false;
        report.iterations = std::max(report.iterations, solve_island(search, limits, unfelt, converged));
        if (!converged) keep_what_takes_energy(search);
        report.converged = report.converged && converged;
        for (size_t k = 0; k < island.size(); k++) {
            Vec3& impulse = impulses[size_t(island[k])] = search.impulses.segment<3>(3 * Eigen::Index(k));
            // Changes up to `unfelt` were skipped, so the impulse may lie outside its friction cone.
            const Touch& touch = touches[size_t(island[k])];
            if (touch.is_bond) continue;
            const double push = impulse.dot(touch.normal);
            impulse = in_cone(touch, std::clamp(push, 0.0, touch.most_push), impulse - push * touch.normal);
        }
    }
    return report;
}

}  // namespace frond
