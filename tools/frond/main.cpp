// frond: inspect plant files, run scenes, grow plants, measure, study.
#include <cstdio>

#include "commands.hpp"
#include "scenes/scene.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Plants that bend, for worlds simulated by the Bullet physics engine."};
    app.name("frond");
    app.set_version_flag("--version", frond_version_string());
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::help);
    frond::tools::add_inspect(app);
    frond::tools::add_run(app);
    frond::tools::add_view(app);
    frond::tools::add_grow(app);
    frond::tools::add_bench(app);
    frond::tools::add_study(app);
    frond::tools::add_export(app);
    frond::tools::add_stability(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "frond: %s\n", error.what());
        return 1;
    }
}
