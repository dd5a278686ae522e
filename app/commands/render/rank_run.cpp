#include "commands/render/rank_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "backends/backends.h"
#include "console/exit_codes.h"
#include "console/interrupt.h"
#include "console/output.h"
#include "console/repeat_command.h"
#include "console/report.h"
#include "error.h"
#include "ranks/launcher.h"

namespace diptych::core::app {

namespace {

int exit_code_of(const Error& error) {
    const bool no_device =
        dynamic_cast<const NoDevice*>(&error) != nullptr || dynamic_cast<const DeviceLost*>(&error) != nullptr;
    return no_device ? exit_no_device : exit_bad_input;
}

}  // namespace

bool is_silent_rank() {
    const char* const rank = std::getenv("PMIX_RANK");  // mpirun of Open MPI and srun --mpi=pmix both set it
    return rank != nullptr && std::atoi(rank) > 0 && !launcher().empty();
}

int RankRun::run(const std::function<int(RankRun&)>& work) {
    InterruptGuard interrupt;
    RankRun run;
    TeamHooks hooks;
    hooks.interrupted = [&] { return interrupt.requested().load(); };
    hooks.interrupt_code = interrupt_exit_code;
    hooks.warn = [](const std::string& line) { report_warning(line); };
    hooks.note = [&](const std::string& text) { run.note(text); };
    run.team_ = std::make_unique<Team>(join_ranks(), hooks);
    Team& team = *run.team_;
    int code = exit_done;
    try {
        code = work(run);
    } catch (const Error& error) {
        if (run.leads()) {
            team.end(exit_code_of(error));
            team.leave({.alone = team.state().anyone_died});
            throw;
        }
        team.tell_gave_up(error.what());
    } catch (const std::exception& error) {
        if (run.leads()) {
            team.end(exit_bad_input);
            team.leave({.alone = team.state().anyone_died});
            throw;
        }
        team.tell_gave_up(fmt::format("internal error: {}", error.what()));
    }
    if (run.leads()) {
        team.end(code);
        team.leave({.alone = team.state().anyone_died});
        return code;
    }
    const Order end = team.wait_for_end();
    team.leave(end);
    return end.code;
}

void RankRun::take_share(RenderRequest& request) const {
    const RankPlace& place = team_->place();
    if (request.backend == "vulkan") {
        request.device = request.device.empty() ? device_in_turn(place.local_rank) : request.device;
    } else if (request.threads == 0) {
        request.threads = std::max(1, place.processors / place.sharing);
    }
}

void RankRun::report(const std::string& line, const nlohmann::ordered_json& json, int exit_code) {
    team_->tell_note(nlohmann::ordered_json({{"line", line}, {"json", json}, {"exit_code", exit_code}}).dump());
}

void RankRun::note(const std::string& text) {
    const nlohmann::ordered_json note = nlohmann::ordered_json::parse(text);
    write_note(note["line"].get<std::string>());
    const std::lock_guard lock(mutex_);
    results_.json.push_back(note["json"]);
    const int code = note["exit_code"];
    results_.exit_code = results_.exit_code == exit_done ? code : results_.exit_code;
}

RankRun::Results RankRun::results() {
    const std::lock_guard lock(mutex_);
    return results_;
}

std::string RankRun::command() const {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string words{std::istreambuf_iterator<char>(file), {}};
    std::string command = fmt::format("{} -n {}", launcher(), team_->place().size);
    for (std::size_t begin = 0; begin < words.size();) {
        const std::size_t end = std::min(words.find('\0', begin), words.size());
        command += " " + shell_quoted(words.substr(begin, end - begin));
        begin = end + 1;
    }
    return command;
}

}  // namespace diptych::core::app
