// The table of sweeps, each in a process of its own.
#include <cstdio>
#include <map>
#include <tuple>

#include "stability/sweeps.hpp"

namespace frond::stability {

std::vector<Sweep> sweeps(bool quick) {
    const std::vector<double> speeds =
        quick ? std::vector<double>{0.5, 5, 50} : std::vector<double>{0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
    const std::vector<double> rates = quick ? std::vector<double>{60} : std::vector<double>{240, 60, 30};
    std::vector<Sweep> all;
    for (int meeting = 0; meeting < int(Meeting::COUNT); meeting++)
        for (const frond_mechanics mechanics : {FROND_MECHANICS_ROD, FROND_MECHANICS_TET_COROTATIONAL})
            for (const double rate : rates)
                for (const double speed : speeds) all.push_back({Meeting(meeting), mechanics, speed, 1 / rate});
    return all;
}

std::vector<SweptCell> run_sweeps(bool quick, const Limits& limits, const std::function<void(int)>& tell) {
    std::vector<SweptCell> cells;
    for (const Sweep& sweep : sweeps(quick)) cells.push_back({sweep, {}});
    const std::vector<Verdict> verdicts = run_apart(
        cells.size(), limits, [&](size_t i) { return run_sweep(cells[i].sweep); }, tell);
    for (size_t i = 0; i < cells.size(); i++) cells[i].verdict = verdicts[i];
    return cells;
}

std::string text_of(const std::vector<SweptCell>& cells) {
    std::string text =
        "o: nothing passes; -: passes by more than half of the plant's size in a step, and says so;\n"
        "!: passes, and says so; X: passes in silence; ?: fails otherwise\n\n";
    using Row = std::tuple<int, int, double>;
    std::map<Row, std::string> rows;
    std::string head;
    char part[80];
    const Sweep& first = cells.front().sweep;
    for (const auto& [sweep, verdict] : cells) {
        const char* sign = verdict.color == Color::GREEN         ? "o"
                           : verdict.color == Color::GREY        ? "-"
                           : verdict.text == "passes"            ? "!"
                           : verdict.text == "passes in silence" ? "X"
                                                                 : "?";
        std::snprintf(part, sizeof part, "%5s", sign);
        rows[{int(sweep.meeting), int(sweep.mechanics), -1 / sweep.dt}] += part;
        if (sweep.meeting != first.meeting || sweep.mechanics != first.mechanics || sweep.dt != first.dt) continue;
        std::snprintf(part, sizeof part, "%5g", sweep.speed);
        head += part;
    }
    std::snprintf(part, sizeof part, "%-22s%-18s%-7s", "speed [m/s]", "", "");
    text += part + head + "\n";
    for (const auto& [row, signs] : rows) {
        std::snprintf(part, sizeof part, "%-22s%-18s1/%-5.0f", name_of(Meeting(std::get<0>(row))),
                      frond_mechanics_name(frond_mechanics(std::get<1>(row))), -std::get<2>(row));
        text += part + signs + "\n";
    }
    return text;
}

}  // namespace frond::stability
