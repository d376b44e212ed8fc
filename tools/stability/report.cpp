// In: verdicts. Out: the table as text, as JSON, and as one self-contained HTML page.
#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "stability/stability.hpp"

namespace frond::stability {

namespace {

// A summary cell: all results of a case with one mechanics.
struct Tally {
    int green = 0, red = 0, grey = 0;
    const Result* worst = nullptr;  // first red one, preferring unexplained ones, then the default integrator
    void add(const Result& result) {
        const Color color = result.verdict.color;
        green += color == Color::GREEN;
        grey += color == Color::GREY;
        if (color != Color::RED) return;
        red++;
        const auto rank = [](const Result& of) {
            return 2 * is_unexplained(of) + (of.cell.integrator == FROND_INTEGRATOR_BDF2);
        };
        if (!worst || rank(result) > rank(*worst)) worst = &result;
    }
};
using Key = std::pair<const Case*, int>;

std::map<Key, Tally> tally(const std::vector<Result>& results) {
    std::map<Key, Tally> tallies;
    for (const Result& result : results) tallies[{result.of, result.cell.mechanics}].add(result);
    return tallies;
}

// Returns the cases that were run, in the order of the table.
std::vector<const Case*> cases_in(const std::vector<Result>& results) {
    std::vector<const Case*> list;
    for (const Result& result : results)
        if (list.empty() || list.back() != result.of) list.push_back(result.of);
    return list;
}

std::string cell_text(const Tally& tally) {
    if (tally.red + tally.green == 0) return "-";
    return (tally.red ? "RED " : "ok ") + std::to_string(tally.green) + "/" + std::to_string(tally.green + tally.red);
}

const char* color_name(Color color) {
    return color == Color::GREEN ? "green" : color == Color::RED ? "red" : "grey";
}

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    return out;
}

// Numbers of red cells with one mechanics, for the default integrator and for all.
struct Counts {
    int cells = 0, red = 0, red_default = 0;
};
std::vector<Counts> count(const std::vector<Result>& results) {
    std::vector<Counts> counts(FROND_MECHANICS_COUNT);
    for (const Result& result : results) {
        Counts& of = counts[size_t(result.cell.mechanics)];
        const bool is_red = result.verdict.color == Color::RED;
        of.cells += result.verdict.color != Color::GREY;
        of.red += is_red;
        of.red_default += is_red && result.cell.integrator == FROND_INTEGRATOR_BDF2;
    }
    return counts;
}

}  // namespace

std::string text_of(const std::vector<Result>& results) {
    const auto tallies = tally(results);
    char line[600];
    std::string text;
    std::snprintf(line, sizeof line, "%-20s", "green / all");
    text += line;
    const auto each_mechanics = [&](auto&& add) {
        for (int m = 0; m < FROND_MECHANICS_COUNT; m++) add(frond_mechanics(m));
        text += "\n";
    };
    each_mechanics([&](frond_mechanics m) {
        std::snprintf(line, sizeof line, " %-16s", frond_mechanics_name(m));
        text += line;
    });
    for (const Case* one : cases_in(results)) {
        std::snprintf(line, sizeof line, "%-20s", one->name);
        text += line;
        each_mechanics([&](frond_mechanics m) {
            const auto found = tallies.find({one, m});
            std::snprintf(line, sizeof line, " %-16s", found == tallies.end() ? "" : cell_text(found->second).c_str());
            text += line;
        });
    }
    const std::vector<Counts> counts = count(results);
    for (int of_default = 1; of_default >= 0; of_default--) {
        std::snprintf(line, sizeof line, "%-20s", of_default ? "red with bdf2" : "red in all");
        text += line;
        each_mechanics([&](frond_mechanics m) {
            const Counts& c = counts[size_t(m)];
            std::snprintf(line, sizeof line, " %-16d", of_default ? c.red_default : c.red);
            text += line;
        });
    }
    for (const auto& [key, one] : tallies) {
        if (!one.worst) continue;
        const char* known = known_limit(*one.worst);
        std::snprintf(line, sizeof line, "red: %s, %s: %s%s%s\n", key.first->name, text_of(one.worst->cell).c_str(),
                      one.worst->verdict.text.c_str(), known ? " | known: " : "", known ? known : "");
        text += line;
    }
    const auto count_of = [&](Color color) {
        return int(std::count_if(results.begin(), results.end(),
                                 [&](const Result& result) { return result.verdict.color == color; }));
    };
    std::snprintf(line, sizeof line, "%zu cells: %d green, %d grey (not applicable), %d red, %d of them unexplained\n",
                  results.size(), count_of(Color::GREEN), count_of(Color::GREY), count_of(Color::RED),
                  int(std::count_if(results.begin(), results.end(), is_unexplained)));
    return text + line;
}

std::string json_of(const std::vector<Result>& results) {
    nlohmann::ordered_json root;
    root["version"] = frond_version_string();
    for (const Result& result : results) {
        nlohmann::ordered_json cell;
        cell["case"] = result.of->name;
        cell["mechanics"] = frond_mechanics_name(result.cell.mechanics);
        cell["integrator"] = frond_integrator_name(result.cell.integrator);
        cell["time_step"] = result.cell.dt;
        cell["color"] = color_name(result.verdict.color);
        cell["why"] = result.verdict.text;
        if (const char* known = known_limit(result)) cell["known_limit"] = known;
        cell["trouble"] = result.verdict.trouble;
        cell["cpu_seconds"] = result.verdict.seconds;
        root["cells"].push_back(cell);
    }
    return root.dump(1);
}

std::string html_of(const std::vector<Result>& results) {
    std::string page =
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Frond: hard cases</title><style>"
        "body{font:14px sans-serif;margin:2em}table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:2px "
        "6px;"
        "text-align:left;vertical-align:top}.green{background:#bfe5bf}.red{background:#f2a6a6}.grey{background:#ddd}"
        ".known{background:#f2dba6}i{display:inline-block;width:9px;height:9px;margin:1px}</style><h1>Frond " +
        std::string(frond_version_string()) +
        ": hard cases</h1><p>A square is a cell: rows are integrators, columns time steps of 1/240, 1/60, 1/30, 1/10 "
        "s. "
        "Green: passed. Red: not. Amber: not, as is known of the method. Grey: has no meaning there. Point at one to "
        "see "
        "why.</p><table><tr><th>case<th>passes if";
    for (int m = 0; m < FROND_MECHANICS_COUNT; m++)
        page += "<th>" + std::string(frond_mechanics_name(frond_mechanics(m)));
    size_t next = 0;
    for (const Case* one : cases_in(results)) {
        page += "\n<tr><td><b>" + escaped(one->name) + "</b><br>" + escaped(one->does) + "<td>" + escaped(one->passes);
        for (int m = 0; m < FROND_MECHANICS_COUNT; m++) {
            page += "<td>";
            int row = -1;
            for (; next < results.size() && results[next].of == one && results[next].cell.mechanics == m; next++) {
                const Result& result = results[next];
                if (row >= 0 && row != result.cell.integrator) page += "<br>";
                row = result.cell.integrator;
                const bool known = known_limit(result);
                page += "<i class=\"" + std::string(known ? "known" : color_name(result.verdict.color)) +
                        "\" title=\"" + escaped(text_of(result.cell) + ": " + result.verdict.text) + "\"></i>";
            }
        }
    }
    return page + "</table></html>\n";
}

}  // namespace frond::stability
