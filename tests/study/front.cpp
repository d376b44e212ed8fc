#include <gtest/gtest.h>

#include <random>

#include "study/study.hpp"

using namespace frond::study;

namespace front_tests {

Point point(double cpu, double error, const char* failure = "") {
    Point p = {"series", {}, {}, failure, false, false};
    p.outcome.cpu_per_second = cpu;
    p.outcome.error = error;
    return p;
}

TEST(Front, KeepsWhatNothingBeatsInBothCostAndError) {
    std::vector<Point> points = {point(1, 1),    point(2, 0.5), point(3, 0.6),
                                 point(2, 0.7),  point(4, 0.1), point(0.5, 0.01, "unstable"),
                                 point(0.1, NAN)};
    mark_front(points);
    const std::vector<bool> wanted = {true, true, false, false, true, false, false};
    for (size_t i = 0; i < points.size(); i++) EXPECT_EQ(points[i].on_front, wanted[i]) << i;
}

TEST(Front, IsTheSameAsByComparingAllPairs) {
    std::mt19937 dice(3);
    std::vector<Point> points;
    for (int i = 0; i < 300; i++) points.push_back(point(1 + int(dice() % 40), 1 + int(dice() % 40)));
    mark_front(points);
    for (const Point& a : points) {
        bool beaten = false, has_twin_on_front = false;
        for (const Point& b : points) {
            const bool as_good =
                b.outcome.cpu_per_second <= a.outcome.cpu_per_second && b.outcome.error <= a.outcome.error;
            const bool better =
                b.outcome.cpu_per_second < a.outcome.cpu_per_second || b.outcome.error < a.outcome.error;
            beaten |= as_good && better;
            has_twin_on_front |= as_good && !better && b.on_front;
        }
        EXPECT_EQ(has_twin_on_front, !beaten);
        EXPECT_FALSE(a.on_front && beaten);
    }
}

TEST(Front, OfNothingIsNothing) {
    std::vector<Point> points;
    mark_front(points);
    EXPECT_TRUE(points.empty());
}

}  // namespace front_tests
