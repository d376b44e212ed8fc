// In: overlapping contacts and their coupling. Out: impulses on positions, by projected Gauss-Seidel along the normals.
#include "solve/position_correction.hpp"

#include <algorithm>
#include <cmath>

namespace frond {

namespace {

struct Along {
    int other;
    double compliance;  // along the other's normal, by an impulse along this one's [1/kg]
};

// Row of W of a contact, filled when its impulse first changes.
struct Row {
    bool known = false;
    double own = 0, compliance = 0;  // compliance to its own impulse, along the normal and in all directions [1/kg]
    std::vector<Along> others;
};

struct CorrectionSearch {
    const std::vector<Touch>& touches;
    const CouplingTable& coupling;
    std::vector<double> pushes, speeds;  // along the normals
    std::vector<Row> rows;
};

const Row& row_of(CorrectionSearch& search, int i) {
    Row& row = search.rows[size_t(i)];
    if (row.known) return row;
    row.known = true;
    const Vec3& normal = search.touches[size_t(i)].normal;
    Vec3 own = Vec3::Zero();
    for (const Coupling& c : search.coupling.row(i)) {
        const Vec3 compliance = c.block.transpose() * normal;
        row.others.push_back({c.other, compliance.dot(search.touches[size_t(c.other)].normal)});
        if (c.other == i) own += compliance;
    }
    row.own = own.dot(normal);
    row.compliance = own.norm();
    return row;
}

// Does a round over an island's contacts; returns whether another one is of use.
bool sweep(CorrectionSearch& search, const std::vector<int>& island, double tolerance, double unfelt) {
    double most = 0, largest = 0, speed = 0;
    for (const int i : island) {
        double& push = search.pushes[size_t(i)];
        const double lacking = search.touches[size_t(i)].least_correction - search.speeds[size_t(i)];
        if (push == 0 && lacking <= 0) continue;
        const Row& row = row_of(search, i);
        const double all = row.own > IMMOVABLE ? push + lacking / row.own : push;
        const double by = std::clamp(all, 0.0, search.touches[size_t(i)].most_correction) - push;
        push += by;
        if (by != 0)
            for (const Along& along : row.others) search.speeds[size_t(along.other)] += along.compliance * by;
        most = std::max(most, std::abs(by));
        largest = std::max(largest, push);
        speed = std::max(speed, row.compliance * std::abs(by));
    }
    return most > tolerance * largest && speed > unfelt;
}

}  // namespace

std::vector<Vec3> correct_positions(const std::vector<Touch>& touches, const CouplingTable& coupling,
                                    const ImpulseLimits& limits) {
    constexpr int MOST = 40;         // rounds
    constexpr double UNSEEN = 1e-3;  // [m/s]
    const auto overlaps = [](const Touch& touch) { return touch.least_correction > 0; };
    if (std::none_of(touches.begin(), touches.end(), overlaps)) return {};
    const size_t count = touches.size();
    const int rounds = std::min(limits.iterations, MOST);
    CorrectionSearch search = {touches, coupling, std::vector<double>(count, 0), std::vector<double>(count, 0),
                               std::vector<Row>(count)};
    for (const std::vector<int>& island : coupling.islands)
        for (int round = 0; round < rounds && sweep(search, island, limits.tolerance, UNSEEN); round++) {
        }
    std::vector<Vec3> corrections(count);
    for (size_t i = 0; i < count; i++) corrections[i] = search.pushes[i] * touches[i].normal;
    return corrections;
}

}  // namespace frond
