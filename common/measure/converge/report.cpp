#include "measure/converge/report.h"

#include <fmt/format.h>

#include <cmath>

#include "settings/names.h"

namespace diptych::core {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Interval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json to_json(const BiasSquared& bias) {
    return {{"value", bias.value}, {"standard_error", bias.standard_error}, {"p", bias.p}, {"heavy", bias.heavy}};
}

Json to_json(const BiasFit& fit) {
    return {{"bias_squared", to_json(fit.bias_squared)},
            {"noise", fit.noise},
            {"standard_error", fit.standard_error},
            {"p", fit.p}};
}

Json to_json(const CheckpointSummary& point) {
    Json json;
    json["spp"] = point.spp;
    json["device_seconds"] = point.device_seconds;
    json["wall_seconds"] = point.wall_seconds;
    json["mse"] = to_json(point.mse);
    json["relmse"] = to_json(point.relmse);
    json["relmse_trimmed"] = to_json(point.relmse_trimmed);
    json["trimmed_energy"] = point.trimmed_energy;
    json["mse_net"] = point.mse_net;
    json["relmse_net"] = point.relmse_net;
    json["efficiency"] = point.efficiency;
    json["bias_squared"] = to_json(point.bias);
    json["relative_bias_squared"] = to_json(point.relative_bias);
    json["nonfinite"] = point.nonfinite;
    return json;
}

}  // namespace

const char* name_of(TargetTime::Kind kind) {
    switch (kind) {
    case TargetTime::Kind::reached:
        return "reached";
    case TargetTime::Kind::earlier:
        return "earlier";
    case TargetTime::Kind::later:
        return "later";
    default:
        return "unknown";
    }
}

namespace {

/// As results.jsonl has it; null where there is none.
template <class Event>
Json event_to_json(const Method& method, const std::optional<Event>& event) {
    return event ? core::to_json(method.name, *event) : Json();
}

Json to_json(const MethodSummary& summary, const PictureMaker& maker) {
    const RenderRequest& request = summary.method->request;
    const bool oracle = request.backend == "oracle";
    Json json;
    json["method"] = summary.method->name;
    json["backend"] = request.backend;
    json["integrator"] = oracle ? "oracle/" + request.oracle_mode : core::name_of(request.settings.integrator);
    json["sampler"] = oracle ? "independent" : core::name_of(request.settings.sampler);
    json["runs"] = summary.runs;
    json["first_seed"] = request.settings.seed;
    json["setup"] = event_to_json(*summary.method, summary.setup);
    json["slope_mse"] = to_json(summary.slope_mse);
    json["slope_relmse"] = to_json(summary.slope_relmse);
    json["fit"] = to_json(summary.fit);
    json["fit_relmse"] = to_json(summary.fit_relmse);
    json["fit_relmse"]["adjusted_p"] = summary.fit_p;
    json["bias"] = {
        {"adjusted_p", summary.bias_p}, {"significant", summary.bias_p < bias_alpha}, {"text", summary.bias_text}};
    json["time_to_target"] = {{"kind", name_of(summary.to_target.kind)}, {"device_seconds", summary.to_target.seconds}};
    json["picture"] = event_to_json(*summary.method, summary.picture);
    json["command"] = maker.command ? maker.command(request, summary.checkpoints.back().spp) : "";
    json["checkpoints"] = Json::array();
    for (const CheckpointSummary& point : summary.checkpoints) {
        json["checkpoints"].push_back(to_json(point));
    }
    return json;
}

std::string time_text(double seconds) {
    return seconds >= 1 ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.3g} ms", 1000 * seconds);
}

}  // namespace

nlohmann::ordered_json summary_to_json(const ReportHead& head, const ConvergeSummary& summary,
                                       const ReferencePicture& reference, const ConvergeState& state) {
    const RenderSettings& settings = head.request.settings;
    Json json;
    json["scene"] = head.request.scene;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["max_depth"] = settings.max_depth;
    json["runs"] = head.settings.runs;
    json["program"] = head.settings.maker.program;
    json["commit"] = head.commit;
    json["command"] = head.command;
    json["load_seconds"] = state.load_seconds() ? Json(*state.load_seconds()) : Json();
    json["reference"] = {{"method", reference.method},
                         {"spp", reference.spp},
                         {"variance_known", reference.variance_known},
                         {"command", reference.command},
                         {"mse", summary.noise.mse},
                         {"mse_error", summary.noise.mse_error},
                         {"relmse", summary.noise.relmse},
                         {"relmse_error", summary.noise.relmse_error},
                         {"mean", summary.noise.mean}};
    json["target_relmse"] = summary.target_relmse;
    json["equal_seconds"] = summary.equal_seconds;
    json["methods"] = Json::array();
    for (const MethodSummary& method : summary.methods) {
        json["methods"].push_back(to_json(method, head.settings.maker));
    }
    return json;
}

std::span<const SummaryColumn> summary_columns() {
    using P = CheckpointSummary;
    static constexpr SummaryColumn columns[] = {
        {"spp", [](const P& p) -> double { return p.spp; }},
        {"device_seconds", [](const P& p) { return p.device_seconds; }},
        {"wall_seconds", [](const P& p) { return p.wall_seconds; }},
        {"mse", [](const P& p) { return p.mse.value; }},
        {"mse_low", [](const P& p) { return p.mse.low; }},
        {"mse_high", [](const P& p) { return p.mse.high; }},
        {"relmse", [](const P& p) { return p.relmse.value; }},
        {"relmse_low", [](const P& p) { return p.relmse.low; }},
        {"relmse_high", [](const P& p) { return p.relmse.high; }},
        {"relmse_trimmed", [](const P& p) { return p.relmse_trimmed.value; }},
        {"trimmed_energy", [](const P& p) { return p.trimmed_energy; }},
        {"mse_net", [](const P& p) { return p.mse_net; }},
        {"relmse_net", [](const P& p) { return p.relmse_net; }},
        {"efficiency", [](const P& p) { return p.efficiency; }},
        {"bias_squared", [](const P& p) { return p.bias.value; }},
        {"bias_squared_error", [](const P& p) { return p.bias.standard_error; }},
        {"relative_bias_squared", [](const P& p) { return p.relative_bias.value; }},
        {"relative_bias_squared_error", [](const P& p) { return p.relative_bias.standard_error; }},
        {"relative_bias_p", [](const P& p) { return p.relative_bias.p; }},
        {"heavy", [](const P& p) { return p.relative_bias.heavy; }},
        {"nonfinite", [](const P& p) { return static_cast<double>(p.nonfinite); }},
    };
    return columns;
}

std::string summary_to_csv(const ConvergeSummary& summary) {
    std::string text = "method,runs";
    for (const SummaryColumn& column : summary_columns()) {
        text += fmt::format(",{}", column.name);
    }
    text += "\n";
    for (const MethodSummary& method : summary.methods) {
        for (const CheckpointSummary& point : method.checkpoints) {
            text += fmt::format("{},{}", method.method->name, method.runs);
            for (const SummaryColumn& column : summary_columns()) {
                const double value = column.value(point);
                const bool counts = value == std::floor(value) && value < 1e15;  // written as they are
                const std::string figure = counts ? fmt::format("{:.0f}", value) : fmt::format("{:.9g}", value);
                text += "," + (std::isfinite(value) ? figure : "");
            }
            text += "\n";
        }
    }
    return text;
}

std::string summary_table(const ReportHead& head, const ConvergeSummary& summary, const ReferencePicture& reference) {
    const RenderSettings& settings = head.request.settings;
    std::string text = fmt::format("{} at {}x{}, {} runs per method; reference: {}{}\n", head.request.scene,
                                   settings.width, settings.height, head.settings.runs, reference.method,
                                   reference.spp > 0 ? fmt::format(", {} spp", reference.spp) : "");
    text += fmt::format("{:<26} {:>8} {:>9} {:>10} {:>7} {:>15} {:>13}  bias\n", "method", "spp", "time", "relMSE",
                        "slope", "95 %", fmt::format("to {:.2g}", summary.target_relmse));
    for (const MethodSummary& method : summary.methods) {
        const CheckpointSummary& last = method.checkpoints.back();
        const char* mark = method.to_target.kind == TargetTime::Kind::earlier ? "<"
                           : method.to_target.kind == TargetTime::Kind::later ? ">"
                                                                              : "";
        text += fmt::format("{:<26} {:>8} {:>9} {:>10.3g} {:>7.3f} {:>15} {:>13}  {}{}\n", method.method->name,
                            last.spp, time_text(last.device_seconds), last.relmse_net, method.slope_mse.value,
                            fmt::format("[{:.3f}, {:.3f}]", method.slope_mse.low, method.slope_mse.high),
                            mark + time_text(method.to_target.seconds), method.bias_text,
                            last.nonfinite > 0 ? fmt::format("; {} samples were not finite", last.nonfinite) : "");
    }
    return text + "\"slope\" is that of log MSE over log samples; independent samples give -1.";
}

}  // namespace diptych::core
