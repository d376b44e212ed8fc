// frond grow KIND: writes a plant made by rule as an OBJ file.
#include "grow/grow.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"

namespace frond::tools {
namespace {

struct GrowOptions {
    std::string kind, folder;
    uint64_t seed = 1;
    std::vector<std::string> assignments;
};

grow::GrownSettings settings_of(const std::vector<std::string>& assignments) {
    grow::GrownSettings settings;
    for (const std::string& assignment : assignments) {
        const size_t equals = assignment.find('=');
        size_t used = 0;
        double value = 0;
        try {
            value = std::stod(equals == std::string::npos ? "" : assignment.substr(equals + 1), &used);
        } catch (const std::exception&) {
            used = std::string::npos;
        }
        if (equals == std::string::npos || used != assignment.size() - equals - 1)
            throw std::invalid_argument("\"" + assignment + "\": write parameter=number");
        settings[assignment.substr(0, equals)] = value;
    }
    return settings;
}

}  // namespace

void add_grow(CLI::App& app) {
    auto options = std::make_shared<GrowOptions>();
    CLI::App* command = app.add_subcommand("grow", "write a plant made by rule as an OBJ file");
    std::string kinds, parameters;
    for (const grow::GrownKind& kind : grow::grown_kinds()) {
        kinds += std::string(kinds.empty() ? "" : ", ") + kind.name;
        parameters += std::string(kind.name) + ": " + kind.text + "\n";
        for (const grow::GrownParameter& p : kind.parameters) {
            char line[256];
            std::snprintf(line, sizeof line, "  %-22s %g .. %g, default %g: %s\n", p.name, p.low, p.high, p.value,
                          p.text);
            parameters += line;
        }
    }
    command->add_option("kind", options->kind, kinds)->required();
    command->add_option("--out", options->folder, "folder, default: the kind's name");
    command->add_option("--seed", options->seed, "default 1, which gives the files in models/");
    command->add_option("--set", options->assignments, "parameter=number, may be repeated");
    command->footer("Kinds and parameters of --set:\n" + parameters);
    command->callback([options] {
        const grow::GrownPlant plant =
            grow::grow_plant(options->kind, settings_of(options->assignments), options->seed);
        const std::string path = grow::write_obj(plant, options->folder.empty() ? options->kind : options->folder);
        std::printf("%s: %zu vertices, %zu triangles, %zu organs\n", path.c_str(), plant.positions.size(),
                    plant.triangles.size(), plant.organs.size());
    });
}

}  // namespace frond::tools
