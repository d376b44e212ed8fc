// Delta debugging: Zeller and Hildebrandt 2002, "Simplifying and isolating failure-inducing input", without its search
// among kept parts alone, since operations stand on those before them.
#include "programs/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace frond::programs {

namespace {

struct Shrinker {
    Program best;
    const StillBreaks& still_breaks;
    const std::function<bool()>& is_over;

    bool take(Program candidate) {
        prune(candidate);
        if (is_over() || !still_breaks(candidate)) return false;
        best = std::move(candidate);
        return true;
    }

    // Tries to do without each run of `size` operations, from the end; the first one makes the world. Returns whether
    // any was left out.
    bool leave_out(size_t size) {
        bool any = false;
        for (size_t end = best.operations.size(); end > 1;) {
            const size_t begin = end > size + 1 ? end - size : 1;
            Program candidate = best;
            candidate.operations.erase(candidate.operations.begin() + long(begin),
                                       candidate.operations.begin() + long(end));
            any |= take(std::move(candidate));
            end = std::min(begin, best.operations.size());
        }
        return any;
    }

    void leave_out_all() {
        for (size_t size = best.operations.size() / 2; size > 1; size /= 2) leave_out(size);
        while (leave_out(1)) continue;
    }

    bool try_number(size_t operation, size_t number, double value) {
        if (best.operations[operation].numbers[number] == value) return false;
        Program candidate = best;
        candidate.operations[operation].numbers[number] = value;
        return take(std::move(candidate));
    }

    // Counts fall to half as often as they can, other numbers lose digits.
    void simplify_number(size_t operation, size_t number) {
        const Parameter& parameter = verb_of(best.operations[operation]).parameters[number];
        const auto value = [&] { return best.operations[operation].numbers[number]; };
        const std::string name = parameter.name;
        const bool is_amount =
            name == "count" || name == "pieces" || name == "branches" || name == "layers" || name == "blades";
        if (is_amount) {
            while (value() > parameter.low &&
                   try_number(operation, number, std::max(parameter.low, std::floor(value() / 2))))
                continue;
            while (value() > parameter.low && try_number(operation, number, value() - 1)) continue;
            return;
        }
        if (value() == parameter.usual || try_number(operation, number, parameter.usual)) return;
        if (parameter.scale == Scale::WHOLE) return;
        for (int digits = 1; digits <= 2; digits++) {
            char text[40];
            std::snprintf(text, sizeof text, "%.*g", digits, value());
            if (try_number(operation, number, std::strtod(text, nullptr))) return;
        }
    }

    void simplify_numbers() {
        for (size_t i = best.operations.size(); i-- > 0;)
            for (size_t k = 0; i < best.operations.size() && k < best.operations[i].numbers.size(); k++)
                simplify_number(i, k);
    }
};

}  // namespace

Program shrink(Program program, const StillBreaks& still_breaks, const std::function<bool()>& is_over) {
    Shrinker shrinker = {std::move(program), still_breaks, is_over};
    shrinker.leave_out_all();
    shrinker.simplify_numbers();
    shrinker.leave_out_all();
    return shrinker.best;
}

}  // namespace frond::programs
