// Plots by gnuplot, for papers and pages that want a file; index.html draws its own.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "commands/converge/page.h"
#include "image/atomic_file.h"
#include "console/report.h"

namespace diptych::core::app {

namespace {

// Okabe and Ito's colours, which the colour-blind tell apart; the page has the same.
constexpr const char* colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                  "#e69f00", "#56b4e9", "#7f6000", "#666666"};
constexpr std::size_t color_count = std::size(colors);

/// Columns: samples, device seconds, relMSE, low, high. Lows that are not positive, which no logarithm shows, become a
/// thousandth.
std::string data_block(const nlohmann::ordered_json& method, std::size_t index) {
    std::string text = fmt::format("$m{} << EOD\n", index);
    for (const auto& point : method.at("checkpoints")) {
        const auto number = [](const nlohmann::ordered_json& value) {
            return value.is_null() ? 0.0 : value.get<double>();
        };
        const double value = number(point.at("relmse").at("value"));
        const double low = number(point.at("relmse").at("low")), high = number(point.at("relmse").at("high"));
        text += fmt::format("{} {:.9g} {:.9g} {:.9g} {:.9g}\n", point.at("spp").get<std::uint32_t>(),
                            point.at("device_seconds").get<double>(), value, low > 0 ? low : value / 1000,
                            high > 0 ? high : value);
    }
    return text + "EOD\n";
}

/// For a quoted string of gnuplot's, no markup wanted.
std::string quoted(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        safe += c == '\'' ? std::string("''") : std::string(1, c);
    }
    return "'" + safe + "'";
}

std::string plot(const nlohmann::ordered_json& summary, const char* stem, int column, const char* x_label) {
    std::string curves;
    std::size_t index = 0;
    for (const auto& method : summary.at("methods")) {
        const char* color = colors[index % color_count];
        const int dash = 1 + static_cast<int>(index / color_count);
        curves += fmt::format(
            "{}$m{} using {}:4:5 with filledcurves fillcolor rgb '{}' fillstyle transparent solid 0.15 notitle, \\\n"
            "  $m{} using {}:3 with linespoints linecolor rgb '{}' dashtype {} linewidth 2 pointtype 7 pointsize 0.5 "
            "title {} noenhanced",
            index > 0 ? ", \\\n  " : "plot ", index, column, color, index, column, color, dash,
            quoted(method.at("method")));
        ++index;
    }
    std::string text = fmt::format("set xlabel '{}'\n", x_label);
    for (const char* terminal : {"svg size 800,560 dynamic enhanced font 'DejaVu Sans,13' background '#ffffff'",
                                 "pngcairo size 1600,1120 enhanced font 'DejaVu Sans,24'"}) {
        const bool svg = terminal[0] == 's';
        text += fmt::format("set terminal {}\nset output '{}.{}'\n{}\nunset output\n", terminal, stem,
                            svg ? "svg" : "png", curves);
    }
    return text;
}

/// Runs `gnuplot plots.gp` in the folder; its words go to plots.log. True where it exits with 0.
bool run_gnuplot(const std::string& folder) {
    const pid_t child = fork();
    if (child == 0) {
        const bool inside = chdir(folder.c_str()) == 0;
        const int log = open("plots.log", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (!inside || log < 0 || dup2(log, STDOUT_FILENO) < 0 || dup2(log, STDERR_FILENO) < 0) {
            _exit(126);
        }
        execlp("gnuplot", "gnuplot", "plots.gp", static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = 0;
    const bool reaped = child > 0 && waitpid(child, &status, 0) == child;
    if (reaped && WIFEXITED(status) && WEXITSTATUS(status) == 127) {
        report_warning(
            "gnuplot is not installed: no plots as SVG and PNG (Debian: gnuplot-nox); index.html draws its own");
        return false;
    }
    if (!reaped || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        report_warning(fmt::format("{}/plots.gp: gnuplot failed, see plots.log", folder));
        return false;
    }
    return true;
}

}  // namespace

bool write_plots(const nlohmann::ordered_json& summary, const ConvergeState& state) {
    std::string text = "# gnuplot plots.gp: relMSE over time and over samples, with 95 % bands over the runs.\n";
    std::size_t index = 0;
    for (const auto& method : summary.at("methods")) {
        text += data_block(method, index++);
    }
    text += "set logscale xy\nset format xy '10^{%T}'\nset grid linecolor rgb '#dddddd'\n"
            "set key below left Left reverse noenhanced samplen 2\nset border linecolor rgb '#555555'\nset ylabel "
            "'relMSE'\n";
    text += fmt::format(
        "set title {} noenhanced\n",
        quoted(fmt::format("{}, {}x{}, {} runs", summary.at("scene").get<std::string>(), summary.at("width").get<int>(),
                           summary.at("height").get<int>(), summary.at("runs").get<int>())));
    text += plot(summary, "error-time", 2, "seconds of rendering");
    text += plot(summary, "error-samples", 1, "samples a pixel");
    write_file_atomically(state.path("plots.gp"), text);
    return run_gnuplot(state.folder());
}

}  // namespace diptych::core::app
