#include "commands/render/rank_picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "clock.h"
#include "commands/render/picture_json.h"
#include "commands/render/rank_share.h"
#include "console/exit_codes.h"
#include "console/output.h"
#include "console/progress_line.h"
#include "console/repeat_command.h"
#include "console/report.h"
#include "error.h"
#include "ranks/film_exchange.h"
#include "render/film_file.h"
#include "render/merge_films.h"

namespace diptych::core::app {

namespace {

/// What all ranks must agree on.
std::string identity_of(const RenderRequest& request, PictureWork& work) {
    RenderOutcome outcome;
    outcome.maker.program = program_version();
    outcome.fingerprint = work.fingerprint();
    return picture_identity(render_metadata(request, outcome));
}

/// The parts of ranks that have died, which rank 0 takes over.
class Adopted {
public:
    Adopted(const PictureWork& work, int ranks, std::string identity, std::uint64_t memory_limit)
        : path_(work.unfinished()), next_(ranks), identity_(std::move(identity)), memory_limit_(memory_limit) {}

    /// Returns the samples of the rank's part. The file gets another rank's name, so that its owner, should it live after
    /// all, writes over nothing.
    SampleRanges adopt(int rank) {
        const std::string part = rank_part_path(path_, rank);
        try {
            if (!std::filesystem::exists(part)) {
                return {};
            }
            std::optional<FilmFile> file = read_film(part, memory_limit_);
            if (!file || file->metadata["uneven"] == "yes" || picture_identity(file->metadata) != identity_) {
                return {};
            }
            std::filesystem::rename(part, rank_part_path(path_, next_++));
            if (film_.pixels.empty()) {
                film_ = std::move(file->film);
            } else {
                merge_films(file->film, film_);
            }
            samples_ += file->samples.count();
            return file->samples;
        } catch (const std::exception& error) {
            report_warning(fmt::format("{}; its samples are rendered again", error.what()));
            return {};
        }
    }

    const Film& film() const { return film_; }
    std::uint64_t samples() const { return samples_; }

private:
    std::string path_;
    int next_;
    std::string identity_;
    std::uint64_t memory_limit_;
    Film film_;
    std::uint64_t samples_ = 0;
};

std::string devices_text(const std::map<std::string, int>& devices) {
    std::vector<std::string> names;
    for (const auto& [name, count] : devices) {
        names.push_back(count > 1 ? fmt::format("{} x {}", count, name) : name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Rank 0's side of a picture.
class PictureOnRanks {
public:
    PictureOnRanks(RankRun& run, Session& session, const RenderRequest& request, bool quiet, PictureWork& work)
        : run_(run), session_(session), request_(request), quiet_(quiet), work_(work),
          adopted_(work, run.team().place().size, identity_of(request, work), kept_film_limit(request)),
          line_(std::in_place, request.spp) {}

    void start() {
        work_.find_kept();
        if (work_.kept().spp > 0 && !quiet_) {
            print_note("{}: going on from its {} samples per pixel\n", fmt::join(work_.kept().paths, ", "),
                       work_.kept().spp);
        }
        work_.gather_kept();
        for (const std::string& part : rank_parts(work_.unfinished())) {  // of samples that are in what was gathered
            std::filesystem::remove(part);
        }
        Work work;
        work.wanted = SampleRanges(work_.wanted()).without(work_.kept().samples);
        work.limits.seconds = request_.seconds > 0 ? std::max(1e-3, request_.seconds - work_.kept().seconds) : 0;
        work.picture = identity_of(request_, work_);
        run_.team().start(std::move(work), [this](int rank) { return adopted_.adopt(rank); });
    }

    void show_progress() {
        const Coordinator::State state = run_.team().state();
        if (state.finished == 0) {
            return;
        }
        const double speed = static_cast<double>(state.finished) / std::max(state.seconds, 1e-12);
        Progress progress;
        progress.spp = work_.kept().spp + static_cast<std::uint32_t>(state.finished);
        progress.seconds = state.seconds;
        progress.eta_seconds = request_.seconds > 0 ? std::max(0.0, request_.seconds - state.seconds)
                                                    : static_cast<double>(state.left) / speed;
        progress.samples_per_second = speed * request_.settings.width * request_.settings.height;
        line_->show(progress);
    }

    int finish(const Film& sum, double merge_seconds) {
        line_.reset();
        const Coordinator::State state = run_.team().state();
        Film film = sum;
        for (const Film* more : {&work_.kept().film, &adopted_.film()}) {
            if (!more->pixels.empty()) {
                merge_films(*more, film);
            }
        }
        SampleRanges samples = work_.kept().samples;
        samples.add(state.samples);
        RenderOutcome outcome = work_.outcome_of(samples, 0, film, devices_text(state.devices));
        if (outcome.uneven || outcome.spp != samples_of_every_pixel(film)) {
            throw Error(fmt::format("{}: the ranks' films have other samples than were handed out", request_.output));
        }
        outcome.seconds = work_.kept().seconds + state.seconds;
        const SavedPicture saved = work_.save(film, outcome);
        if (!saved.fell_back) {
            for (const std::string& part : rank_parts(work_.unfinished())) {
                std::filesystem::remove(part);
            }
        }
        if (outcome.nonfinite > 0) {
            report_warning(fmt::format("{}: {} samples were dropped: they were not finite, or negative", saved.path,
                                       outcome.nonfinite));
        }
        nlohmann::ordered_json json =
            json_of(request_, outcome, saved, session_.renderer(), film, film_totals(film), session_.packed().features);
        json["kept_spp"] = work_.kept().spp;
        json["ranks"] = state.ranks;
        json["merge_seconds"] = merge_seconds;
        if (quiet_) {
            print_json(json);
        } else {
            print_note("{}: {}x{}, {} spp in {:.2f} s on {}, by {} ranks\n", saved.path, film.width, film.height,
                       outcome.spp, outcome.seconds, outcome.device, state.ranks);
        }
        return saved.fell_back ? exit_bad_input : exit_done;
    }

    /// Once all ranks have written what they have.
    int stopped(int code) {
        line_.reset();
        const Coordinator::State state = run_.team().state();
        const std::uint64_t spp = work_.kept().spp + adopted_.samples() + state.units_saved;
        if (spp == 0) {
            report_error(fmt::format("{}: interrupted before the first sample; nothing to save", request_.output));
            return code;
        }
        nlohmann::ordered_json json = {{"interrupted", true}, {"spp", spp}, {"ranks", state.ranks}};
        json["parts"] = rank_parts(work_.unfinished());
        if (quiet_) {
            print_json(json);
        } else {
            print_note("{}: interrupted; {} samples per pixel lie in {}; the same command goes on from them: {}\n",
                       request_.output, spp, fmt::join(parts(), ", "), run_.command());
        }
        return code;
    }

private:
    std::vector<std::string> parts() const {
        std::vector<std::string> parts = rank_parts(work_.unfinished());
        if (std::filesystem::exists(work_.unfinished())) {
            parts.insert(parts.begin(), work_.unfinished());
        }
        return parts;
    }

    RankRun& run_;
    Session& session_;
    const RenderRequest& request_;
    bool quiet_;
    PictureWork& work_;
    Adopted adopted_;
    std::optional<ProgressLine> line_;
};

}  // namespace

int render_picture_on_ranks(RankRun& run, Session& session, const RenderRequest& request, bool quiet,
                            const WorkFiles& files, LossGuard& guard) {
    Team& team = run.team();
    PictureWork work(session, request, files);
    RankShare share(team, session, work, files, guard);
    std::optional<PictureOnRanks> picture;
    if (run.leads()) {
        picture.emplace(run, session, request, quiet, work);
        picture->start();
    }
    team.ready({identity_of(request, work), session.renderer().device()});
    const auto waiting = [&] {
        if (picture) {
            picture->show_progress();
        }
    };
    double merge_seconds = 0;
    std::shared_ptr<const Film> sum;
    Order order = team.next(waiting);
    for (;;) {
        switch (order.kind) {
        case Order::Kind::render:
            share.render(order.block);
            waiting();
            order = team.next(waiting);
            break;
        case Order::Kind::merge: {
            share.finish_checkpoint();
            const Stopwatch watch;
            sum = merge_films_of_ranks(team, order, share.film());
            merge_seconds = watch.seconds();
            order = run.leads() && sum ? team.merged(order.attempt) : team.next(waiting);
            break;
        }
        case Order::Kind::finished:
            return picture->finish(*sum, merge_seconds);
        case Order::Kind::stop: {
            const double seconds = run.leads() ? team.state().seconds : 0;
            team.tell_saved(share.save(seconds));
            return run.leads() ? picture->stopped(team.wait_for_saved().code) : exit_done;
        }
        case Order::Kind::cut_off:
            share.save(0);
            return order.code;
        case Order::Kind::end:
            return order.code;
        case Order::Kind::abandon:
            order = team.next(waiting);
            break;
        }
    }
}

}  // namespace diptych::core::app
