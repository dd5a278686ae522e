#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "session/make_renderer.h"
#include "commands/arguments/typed_text.h"
#include "commands/command.h"
#include "commands/render/rank_run.h"
#include "error.h"
#include "commands/program.h"
#include "console/output.h"
#include "console/report.h"
#include "one_line.h"
#include "commands/suggestion.h"

namespace diptych::core::app {

namespace {

constexpr const char* program_examples = R"(Examples:
  diptych generate cornell -o cornell.gltf
  diptych render cornell.gltf -o cpu.exr --backend cpu --seed 1
  diptych render cornell.gltf -o vulkan.exr --backend vulkan --seed 2
  diptych compare cpu.exr vulkan.exr -o difference.png
  diptych COMMAND --help
Exit codes: 0 done, 1 a check failed, 2 bad usage or input, 3 no suitable device, or it was lost, 128 + n ended by
signal n, such as 130 by Ctrl-C)";

int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    std::string message = one_line(error.what());
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && app.get_subcommands().empty()) {
        message = argc < 2 ? "no command given" : fmt::format("there is no command '{}'", argv[1]);
    }
    report_error(fmt::format("{} ({})", message, suggestion(app, argc, argv)));
    return exit_bad_input;
}

int run_command(int argc, char** argv) {
    CLI::App app(
        "One glTF scene rendered twice, by Embree on the CPU and by Vulkan ray tracing, from one set of shaders.",
        "diptych");
    app.footer(program_examples);
    app.set_version_flag("--version", program_version());
    app.require_subcommand(1);
    Run run;
    add_render(app, run);
    add_merge(app, run);
    add_compare(app, run);
    add_info(app, run);
    add_generate(app, run);
    add_bench(app, run);
    add_verify(app, run);
    add_replay(app, run);
    add_converge(app, run);
    add_stability(app, run);
    add_view(app, run);
    take_text_as_typed(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        std::ostringstream help;
        const int code = app.exit(success, help, help);
        write_result(help.str());
        return code;
    } catch (const CLI::ParseError& error) {
        return usage_error(app, error, argc, argv);
    }
    return exit_code_after_validation(run());
}

int run_and_report_errors(int argc, char** argv) {
    try {
        return run_command(argc, argv);
    } catch (const NoDevice& error) {
        report_error(error.what());
        return exit_no_device;
    } catch (const DeviceLost& error) {
        report_error(error.what());
        return exit_no_device;
    } catch (const Error& error) {
        report_error(error.what());
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        report_error("not enough memory");
        return exit_bad_input;
    } catch (const std::system_error& error) {
        const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
        report_error(no_thread ? "no thread can be started: the limit of processes (ulimit -u) or of the container is reached"
                               : fmt::format("internal error: {}", error.what()));
        return exit_bad_input;
    } catch (const std::exception& error) {
        report_error(fmt::format("internal error: {}", error.what()));
        return exit_bad_input;
    }
}

}  // namespace

int run_program(int argc, char** argv) {
    if (argc > 1 && std::string_view(argv[1]) == "render" && is_silent_rank()) {
        silence_output();
    }
    const int code = run_and_report_errors(argc, argv);
    const std::string reason = reason_of_loss();
    if (reason.empty()) {
        return code;
    }
    report_error("stdout: the results cannot be written: " + reason);
    return code == exit_done || code == exit_check_failed ? exit_bad_input : code;
}

}  // namespace diptych::core::app
