// `render` as one of several processes.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ranks/team.h"
#include "render/request.h"

namespace diptych::core::app {

/// Whether this process is one of several that render together, and another one speaks for all: then no output is written.
bool is_silent_rank();

/// What this process does among the others.
class RankRun {
public:
    /// Calls `work`, which renders, and returns rank 0's exit code on all ranks. Rank 0 returns its own from `work`; the
    /// others return when they have nothing more to do. Where one of these throws, the others take over what it had. Where
    /// rank 0 throws, all end.
    static int run(const std::function<int(RankRun&)>& work);

    Team& team() { return *team_; }
    bool leads() const { return team_->leads(); }

    /// The devices and processors of this rank's share of its host, where the request leaves them open.
    void take_share(RenderRequest& request) const;

    /// Rank 0 prints the line, which may be empty, and returns the JSON from results() at the end. From any rank.
    void report(const std::string& line, const nlohmann::ordered_json& json, int exit_code);
    struct Results {
        std::vector<nlohmann::ordered_json> json;
        int exit_code = 0;  // the first that is not 0
    };
    /// Rank 0 alone, once all ranks have reported.
    Results results();

    /// The command that started all ranks, as far as this process knows it.
    std::string command() const;

private:
    RankRun() = default;
    void note(const std::string& text);

    std::mutex mutex_;
    Results results_;
    std::unique_ptr<Team> team_;
};

}  // namespace diptych::core::app
