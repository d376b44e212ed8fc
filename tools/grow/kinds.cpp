// Grow, the table of kinds. In: a kind's name, settings and a seed. Out: the plant.
#include <stdexcept>

#include "organs.hpp"

namespace frond::grow {
namespace {

struct Row {
    GrownKind kind;
    GrownPlant (*grow)(const GrownSettings&, uint64_t);
};

const std::vector<Row>& rows() {
    static const std::vector<Row> table = {
        {{"corn",
          "corn in flower, 925 vertices and 1184 triangles",
          {{"height", 2.2, 0.5, 4, "of the whole plant [m]"},
           {"leaf_length", 1, 0.4, 1.6, "factor on all blades"},
           {"leaf_width", 1, 0.4, 2, "factor on all blades"},
           {"arch", 1, 0, 1.4, "factor on how far the blades turn down"},
           {"azimuth", 0, -360, 360, "of the plane in which the blades stand [degree]"}}},
         grow_corn},
        {{"cucumber",
          "cucumber in fruit, tied to a stake, 22004 vertices and 30244 triangles",
          {{"height", 2.1, 0.5, 4, "of the whole plant [m]"},
           {"leaf_size", 1, 0.4, 1.6, "factor on all blades"},
           {"petiole_length", 1, 0.4, 1.6, "factor on all petioles"},
           {"droop", 1, 0, 1.5, "factor on how far the blades hang"}}},
         grow_cucumber},
        {{"wheat",
          "tuft of bearded wheat, light enough for a field",
          {{"height", 0.85, 0.3, 1.6, "of the tallest culm [m]"},
           {"ripe", 0.8, 0, 1, "0 green .. 1 straw, nodding"},
           {"spread", 1, 0, 2, "factor on how far the culms lean out"}}},
         grow_wheat},
        {{"sunflower",
          "sunflower in bloom",
          {{"height", 1.7, 0.5, 3.5, "of the stem [m]"},
           {"leaf_size", 1, 0.4, 1.6, "factor on all blades"},
           {"head_size", 1, 0.5, 2, "factor on the head"},
           {"nod", 0.7, 0, 1, "0 looks up .. 1 hangs over"},
           {"azimuth", 60, -360, 360, "that the head faces [degree]"}}},
         grow_sunflower},
        {{"tree",
          "broad-leaved tree, a twig to ten leaves; 18000 leaves are 288,000 triangles",
          {{"leaves", 1800, 100, 20000, "in all; the one parameter that changes how many vertices there are"},
           {"height", 6, 2, 15, "of the whole tree [m]"},
           {"leaf_size", 1, 0.4, 1.6, "factor on all leaves"}}},
         grow_tree},
    };
    return table;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

const std::vector<GrownKind>& grown_kinds() {
    static const std::vector<GrownKind> kinds = [] {
        std::vector<GrownKind> list;
        for (const Row& row : rows()) list.push_back(row.kind);
        return list;
    }();
    return kinds;
}

GrownPlant grow_plant(const std::string& kind, const GrownSettings& settings, uint64_t seed) {
    for (const Row& row : rows()) {
        if (row.kind.name != kind) continue;
        // Start from the defaults; every setting must name one of them and stay within its range.
        GrownSettings values;
        std::vector<std::string> names;
        for (const GrownParameter& parameter : row.kind.parameters) {
            values[parameter.name] = parameter.value;
            names.push_back(parameter.name);
        }
        for (const auto& [name, value] : settings) {
            if (!values.count(name))
                throw std::invalid_argument(kind + " has no setting \"" + name + "\"; it has " + joined(names));
            for (const GrownParameter& parameter : row.kind.parameters) {
                if (name == parameter.name && !(value >= parameter.low && value <= parameter.high))
                    throw std::invalid_argument(kind + ": " + name + " must be from " + std::to_string(parameter.low) +
                                                " to " + std::to_string(parameter.high));
            }
            values[name] = value;
        }
        GrownPlant plant = row.grow(values, seed);
        plant.kind = kind;
        return plant;
    }
    std::vector<std::string> names;
    for (const Row& row : rows()) names.push_back(row.kind.name);
    throw std::invalid_argument("there is no kind \"" + kind + "\"; there are " + joined(names));
}

}  // namespace frond::grow
