// Programs by chance.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "programs/program.hpp"

namespace frond::programs {

namespace {

class Maker {
public:
    explicit Maker(uint64_t seed) : random(seed) {}

    Program make() {
        add("world");
        add_model();
        add("plant");
        if (chance(0.4)) add("plant");
        if (chance(0.5)) add("ground");
        const int count = between(4, 30);
        for (int i = 0; i < count; i++) {
            if (chance(0.55)) add("step");
            add_any();
        }
        add("step");
        return std::move(program);
    }

private:
    std::mt19937_64 random;
    Program program;
    std::map<Kind, std::vector<int>> made;
    int last_id = 0;

    // Numbers are drawn here and not by the library's distributions, so that a seed means the same everywhere.
    double share() { return double(random() >> 11) / double(uint64_t(1) << 53); }
    bool chance(double p) { return share() < p; }
    int between(int low, int high) { return low + int(share() * (high - low + 1)); }

    double draw(const Parameter& p) {
        if (!chance(p.chance)) return p.usual;
        const double s = share();
        if (p.scale == Scale::WHOLE) return std::floor(p.low + s * (p.high - p.low + 1));
        double value = p.low + s * (p.high - p.low);
        if (p.scale == Scale::LOG) value = p.low * std::pow(p.high / p.low, s);
        // Four digits are enough for chance, and can be read.
        char text[40];
        std::snprintf(text, sizeof text, "%.4g", value);
        return std::clamp(std::strtod(text, nullptr), std::min(p.low, p.usual), std::max(p.high, p.usual));
    }

    bool can(const Verb& verb) {
        return std::all_of(verb.of.begin(), verb.of.end(),
                           [&](Kind kind) { return kind == Kind::NONE || !made[kind].empty(); });
    }

    void add(const char* name) { add(verb_called(name)); }
    void add(size_t row) {
        const Verb& verb = verbs()[row];
        Operation operation;
        operation.verb = row;
        for (size_t k = 0; k < 2; k++) {
            std::vector<int>& list = made[verb.of[k]];
            if (verb.of[k] != Kind::NONE) operation.of[k] = list[size_t(between(0, int(list.size()) - 1))];
        }
        for (const Parameter& parameter : verb.parameters) operation.numbers.push_back(draw(parameter));
        if (verb.makes != Kind::NONE) made[verb.makes].push_back(operation.id = ++last_id);
        program.operations.push_back(std::move(operation));
    }

    void add_model() {
        static const char* const WAYS[] = {"stems", "stems", "stems", "model", "model", "tets", "soup"};
        add(WAYS[between(0, 6)]);
    }

    // Most kinds of things are limited in number, so that a world stays quick.
    bool is_enough(const Verb& verb) {
        constexpr size_t PLANTS = 4, OTHERS = 5;
        if (verb.makes == Kind::ROBOT) return !made[Kind::ROBOT].empty();
        return verb.makes != Kind::NONE && made[verb.makes].size() >= (verb.makes == Kind::PLANT ? PLANTS : OTHERS);
    }

    void add_any() {
        int sum = 0;
        for (const Verb& verb : verbs()) sum += can(verb) && !is_enough(verb) ? verb.weight : 0;
        int at = between(0, sum - 1);
        for (size_t i = 0; i < verbs().size(); i++) {
            at -= can(verbs()[i]) && !is_enough(verbs()[i]) ? verbs()[i].weight : 0;
            if (at < 0) return add(i);
        }
    }
};

}  // namespace

Program random_program(uint64_t seed) {
    return Maker(seed).make();
}

}  // namespace frond::programs
