// In: touches and how they are coupled. Out: impulses, by projected Gauss-Seidel: touch by touch the normal impulse and
// then the one across are corrected by what is wrong with the velocity, and projected onto what can be (Moreau 1988,
// Jean 1999, "The non-smooth contact dynamics method").
#include "solve/impulses.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/union_find.hpp"

namespace frond {

namespace {

// How one touch answers to its own impulse, worked out once.
struct Own {
    Mat3 block = Mat3::Zero();
    double along = 0, across = 0;  // correction of an impulse by speed, along the normal and across it [kg]
    Mat3 inverse = Mat3::Zero();   // of a bond, likewise
};

// What nothing can move needs no impulse.
constexpr double IMMOVABLE = 1e-12;  // [1/kg]

}  // namespace

Mat3 firm_inverse(const Mat3& block) {
    const Eigen::SelfAdjointEigenSolver<Mat3> ways(0.5 * (block + block.transpose()));
    Vec3 inverse = Vec3::Zero();
    for (int i = 0; i < 3; i++)
        if (ways.eigenvalues()[i] > std::max(IMMOVABLE, 1e-9 * ways.eigenvalues()[2]))
            inverse[i] = 1 / ways.eigenvalues()[i];
    return ways.eigenvectors() * inverse.asDiagonal() * ways.eigenvectors().transpose();
}

namespace {

Own own_of(const Touch& touch, const std::vector<Coupling>& couplings, int i) {
    Own own;
    for (const Coupling& c : couplings)
        if (c.other == i) own.block += c.block;
    if (touch.is_bond) {
        own.inverse = firm_inverse(own.block);
        return own;
    }
    const double along = touch.normal.dot(own.block * touch.normal);
    const Mat3 flat = Mat3::Identity() - touch.normal * touch.normal.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> sliding(flat * own.block * flat, Eigen::EigenvaluesOnly);
    const double across = sliding.eigenvalues()[2];
    own.along = along > IMMOVABLE ? 1 / along : 0;
    own.across = across > IMMOVABLE ? 1 / across : 0;
    return own;
}

// Touches that answer to each other, directly or through others, in the order of the first of each.
std::vector<std::vector<int>> find_islands(const std::vector<std::vector<Coupling>>& coupling) {
    UnionFind sets(coupling.size());
    for (size_t i = 0; i < coupling.size(); i++)
        for (const Coupling& c : coupling[i]) sets.join(int(i), c.other);
    std::vector<std::vector<int>> islands;
    std::vector<int> number(coupling.size(), -1);
    for (size_t i = 0; i < coupling.size(); i++) {
        int& island = number[size_t(sets.find(int(i)))];
        if (island < 0) {
            island = int(islands.size());
            islands.emplace_back();
        }
        islands[size_t(island)].push_back(int(i));
    }
    return islands;
}

struct Change {
    double largest = 0, most = 0;  // impulse, and change of one [N s]
};

// One touch anew, with all others as they are.
void correct(const Touch& touch, const Own& own, const std::vector<Coupling>& couplings, std::vector<Vec3>& impulses,
             Vec3& impulse, Change& change) {
    Vec3 velocity = touch.velocity;
    for (const Coupling& c : couplings) {
        const Vec3& other = impulses[size_t(c.other)];
        if (!other.isZero(0)) velocity += c.block * other;  // most touches only wait
    }
    const Vec3 before = impulse;
    if (touch.is_bond) {
        impulse += own.inverse * (touch.wanted - velocity);
        change.largest = std::max(change.largest, impulse.norm());
        change.most = std::max(change.most, (impulse - before).norm());
        return;
    }

    // Along the normal: push, never pull.
    const double push_before = before.dot(touch.normal);
    const double lacking = touch.least_speed - velocity.dot(touch.normal);
    const double push = std::max(0.0, push_before + own.along * lacking);

    // Across: against the sliding that the push leaves, no more than friction can.
    velocity += own.block * ((push - push_before) * touch.normal);
    const Vec3 sliding = velocity - velocity.dot(touch.normal) * touch.normal;
    Vec3 hold = before - push_before * touch.normal - own.across * sliding;
    const double most = touch.friction * push, size = hold.norm();
    if (size > most) hold *= most / size;

    impulse = push * touch.normal + hold;
    change.largest = std::max(change.largest, impulse.norm());
    change.most = std::max(change.most, (impulse - before).norm());
}

}  // namespace

ImpulseReport find_impulses(const std::vector<Touch>& touches, const std::vector<std::vector<Coupling>>& coupling,
                            const ImpulseLimits& limits, std::vector<Vec3>& impulses) {
    const size_t count = touches.size();
    impulses.resize(count, Vec3::Zero());
    std::vector<Own> own;
    for (size_t i = 0; i < count; i++) own.push_back(own_of(touches[i], coupling[i], int(i)));

    ImpulseReport report;
    report.converged = true;
    for (const std::vector<int>& island : find_islands(coupling)) {
        bool converged = false;
        int iterations = 0;
        while (iterations < limits.iterations && !converged) {
            iterations++;
            Change change;
            for (const int i : island)
                correct(touches[size_t(i)], own[size_t(i)], coupling[size_t(i)], impulses, impulses[size_t(i)], change);
            converged = change.most <= limits.tolerance * change.largest;
        }
        report.iterations = std::max(report.iterations, iterations);
        report.converged = report.converged && converged;
    }
    return report;
}

}  // namespace frond
