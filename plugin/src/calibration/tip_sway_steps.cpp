// In: a plant's small motion in modes. Out: the error of its tip in steps of a length.
//
// Small motion is linear: what an integrator makes of it is a recurrence, which is run here for the modes in place of
// the plant. Each stage is solve_stage()'s with one solve: it goes on from exact forces at a predicted place with the
// positive stiffness, so that M (v - v_base) = s (f(from) - K+ (x - from)) with x = x_base + s v.
#include <algorithm>
#include <cmath>

#include "calibration/tip_sway.hpp"
#include "core/elementary.hpp"
#include "core/error.hpp"
#include "solve/integrator.hpp"

namespace frond {

namespace {

struct State {
    Sways x, v;
};

class Stepper {
public:
    Stepper(const TipSway& sway, double h) : sway(sway), h(h) {}

    State implicit_euler(const State& at) { return stage(at.x, at.v, h, at.x); }

    State sdirk2(const State& at) {
        const double g = 1 - std::sqrt(0.5), s = g * h, back = (1 - g) / g;
        const State first = stage(at.x, at.v, s, at.x + s * at.v);
        return stage(at.x + back * (first.x - at.x), at.v + back * (first.v - at.v), s, first.x + (h - s) * first.v);
    }

    State bdf2(const State& at) {
        const State was = before;
        before = at;
        if (was.x.size() == 0) return first_of_bdf2(at);
        const Bdf2 after = bdf2_after(h, h);
        return stage(at.x + after.back * (at.x - was.x), at.v + after.back * (at.v - was.v), after.step,
                     at.x + h * at.v);
    }

private:
    // The inverse of I + s^2 K+ for a length s of a stage [s].
    struct Inverse {
        double step;
        SwayMatrix matrix;
    };

    // bdf2.cpp's step_first().
    State first_of_bdf2(const State& at) {
        const State end = sdirk2(at);
        const Sways way = end.x - at.x, off = way - 0.5 * h * (at.v + end.v);
        const bool is_smooth = off.dot(sway.gram * off) <= ROUGH_START * ROUGH_START * way.dot(sway.gram * way);
        return is_smooth ? end : implicit_euler(at);
    }

    State stage(const Sways& x_base, const Sways& v_base, double s, const Sways& from) {
        // A long stage takes the exact stiffness in place of the positive one.
        const bool is_exact = sway.positive.size() == 0 || s > LONG_STAGE;
        State end;
        if (is_exact) {
            end.v = (v_base - s * sway.square.cwiseProduct(x_base))
                        .cwiseQuotient(Sways((1 + s * s * sway.square.array()).matrix()));
        } else {
            const Sways ahead = sway.positive * (x_base - from);
            end.v = inverse_for(s) * (v_base - s * (sway.square.cwiseProduct(from) + ahead));
        }
        end.x = x_base + s * end.v;
        return end;
    }

    const SwayMatrix& inverse_for(double s) {
        for (const Inverse& known : inverses)
            if (known.step == s) return known.matrix;
        const Eigen::Index count = sway.square.size();
        const SwayMatrix matrix = SwayMatrix::Identity(count, count) + s * s * sway.positive;
        inverses.push_back({s, matrix.llt().solve(SwayMatrix::Identity(count, count))});
        return inverses.back().matrix;
    }

    const TipSway& sway;
    double h;
    State before;  // start of the last step, for bdf2
    std::vector<Inverse> inverses;
};

// The tip's exact displacement by a unit force that ceased, at even times [m/N]: cosines of multiples of an angle
// follow from the two before by Chebyshev's recurrence.
class ExactTip {
public:
    ExactTip(const TipSway& sway, double h) : sway(sway), now(sway.start) {
        const Eigen::Index count = sway.square.size();
        cosine.resize(count);
        for (Eigen::Index k = 0; k < count; k++) cosine[k] = frond::cos(std::sqrt(std::max(0.0, sway.square[k])) * h);
        before = cosine.cwiseProduct(now);
    }
    Vec3 place() const { return sway.tip * now; }
    void advance() {
        const Sways next = 2 * cosine.cwiseProduct(now) - before;
        before = now;
        now = next;
    }

private:
    const TipSway& sway;
    Sways cosine, before, now;
};

// Returns the length of time over which an error counts [s].
double length_of_time(const TipSway& exact) {
    return 2 / main_frequency(exact);
}

State take_step(Stepper& stepper, frond_integrator integrator, const State& at) {
    switch (integrator) {
        case FROND_INTEGRATOR_IMPLICIT_EULER:
            return stepper.implicit_euler(at);
        case FROND_INTEGRATOR_BDF2:
            return stepper.bdf2(at);
        case FROND_INTEGRATOR_SDIRK2:
            return stepper.sdirk2(at);
        default:
            fail(FROND_RESULT_INTERNAL, "the error of integrator %d is not known", int(integrator));
    }
}

}  // namespace

double sway_error(const TipSway& sway, const TipSway& exact, frond_integrator integrator, double h) {
    Stepper stepper(sway, h);
    ExactTip tip(exact, h);
    const double first = tip.place().norm();
    State at = {sway.start, Sways::Zero(sway.start.size())};
    const int steps = std::max(1, int(std::lround(length_of_time(exact) / h)));
    double sum = 0;
    for (int i = 1; i <= steps; i++) {
        at = take_step(stepper, integrator, at);
        tip.advance();
        sum += (sway.tip * at.x - tip.place()).squaredNorm();
    }
    return std::sqrt(sum / steps) / first;
}

double sway_error(const TipSway& sway, const TipSway& exact) {
    constexpr int TIMES = 400;  // at which both are compared, in two periods
    const double h = length_of_time(exact) / TIMES;
    ExactTip tip(sway, h), right(exact, h);
    const double first = right.place().norm();
    double sum = 0;
    for (int i = 1; i <= TIMES; i++) {
        tip.advance();
        right.advance();
        sum += (tip.place() - right.place()).squaredNorm();
    }
    return std::sqrt(sum / TIMES) / first;
}

}  // namespace frond
