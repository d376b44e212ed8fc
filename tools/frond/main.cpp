// frond: inspect plant files, run scenes, grow plants, measure, study.
#include <cstdio>

#include "commands.hpp"
#include "scenes/scene.hpp"

namespace {

// Names a command that does not exist; CLI11 would only report that a command is missing.
int explain(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> words = app.remaining(true);
    if (!dynamic_cast<const CLI::RequiredError*>(&error) || words.empty()) return app.exit(error);
    const CLI::App* last = &app;
    while (!last->get_subcommands().empty()) last = last->get_subcommands().front();
    std::string names;
    for (const CLI::App* command : last->get_subcommands([](const CLI::App*) { return true; }))
        names += (names.empty() ? "" : ", ") + command->get_name();
    if (names.empty()) return app.exit(error);
    std::fprintf(stderr, "frond: there is no command \"%s\"; there are %s\n", words.front().c_str(), names.c_str());
    return error.get_exit_code();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Plants that bend, for worlds simulated by the Bullet physics engine."};
    app.name("frond");
    app.set_version_flag("--version", frond_version_string());
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::help);
    frond::tools::add_inspect(app);
    frond::tools::add_run(app);
    frond::tools::add_cook(app);
#ifndef FROND_WITHOUT_PICTURES
    frond::tools::add_gallery(app);
    frond::tools::add_view(app);
    frond::tools::add_grow(app);
    frond::tools::add_bench(app);
    frond::tools::add_study(app);
    frond::tools::add_export(app);
    frond::tools::add_stability(app);
#endif
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return explain(app, error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "frond: %s\n", error.what());
        return 1;
    }
}
