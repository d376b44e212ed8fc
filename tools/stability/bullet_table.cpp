// Runs the cases that exist for both and compares Bullet's soft bodies with Frond.
#include <cstdio>

#include "stability/bullet_beam.hpp"

namespace frond::stability {

namespace {

constexpr frond_mechanics OWN[] = {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_TET_NEOHOOKEAN,
                                   FROND_MECHANICS_ROD};

struct Column {
    std::string name;
    std::function<Verdict(const BulletCase&)> run;
    int green = 0;
    std::vector<std::string> why = {};  // reasons of red cells
};

std::vector<Column> columns(bool quick) {
    std::vector<Column> list;
    for (double dt : quick ? std::vector<double>{1.0 / 60} : std::vector<double>{1.0 / 240, 1.0 / 60}) {
        const std::string at = " 1/" + std::to_string(int(1 / dt + 0.5));
        for (int method = 0; method < int(BulletMethod::COUNT); method++)
            list.push_back({"Bullet " + std::string(name_of(BulletMethod(method))) + at, [=](const BulletCase& one) {
                                return verdict_of([&] { one.run(BulletMethod(method), dt); });
                            }});
        for (frond_mechanics mechanics : OWN)
            list.push_back({frond_mechanics_name(mechanics) + at, [=](const BulletCase& one) {
                                return run_cell(find_case(one.name), {mechanics, FROND_INTEGRATOR_BDF2, dt});
                            }});
    }
    return list;
}

}  // namespace

std::string bullet_table(bool quick, const Limits& limits, const std::function<void(int, int)>& tell) {
    std::vector<Column> table = columns(quick);
    const std::vector<BulletCase>& cases = bullet_cases();
    const size_t count = cases.size() * table.size();
    const std::vector<Verdict> verdicts = run_apart(
        count, limits, [&](size_t i) { return table[i % table.size()].run(cases[i / table.size()]); },
        [&](int done) { tell(done, int(count)); });
    char line[600];
    std::string text;
    for (size_t k = 0; k < table.size(); k++) {
        std::snprintf(line, sizeof line, "%2zu: %s\n", k + 1, table[k].name.c_str());
        text += line;
    }
    text += std::string(20, ' ');
    for (size_t k = 0; k < table.size(); k++) {
        std::snprintf(line, sizeof line, "%5zu", k + 1);
        text += line;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = i % table.size();
        const char* name = cases[i / table.size()].name;
        const bool green = verdicts[i].color == Color::GREEN;
        if (k == 0) {
            std::snprintf(line, sizeof line, "\n%-20s", name);
            text += line;
        }
        text += green ? "   ok" : "  RED";
        table[k].green += green;
        if (!green) table[k].why.push_back(std::string(name) + ": " + verdicts[i].text);
    }
    text += "\n";
    for (const Column& column : table) {
        std::snprintf(line, sizeof line, "%s: %d of %zu hold\n", column.name.c_str(), column.green, cases.size());
        text += line;
        for (const std::string& why : column.why) text += "    " + why + "\n";
    }
    return text;
}

}  // namespace frond::stability
