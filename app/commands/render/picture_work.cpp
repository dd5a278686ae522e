#include "commands/render/picture_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "clock.h"
#include "console/repeat_command.h"
#include "pack/fingerprint.h"
#include "render/merge_films.h"

namespace diptych::core::app {

namespace {

std::uint32_t first_sample(const RenderRequest& request) {
    return request.samples ? static_cast<std::uint32_t>(request.samples->first) : 0;
}

}  // namespace

PictureWork::PictureWork(Session& session, const RenderRequest& request, const WorkFiles& files)
    : session_(session), request_(request), files_(files),
      resumable_(request.backend == "oracle" || !chains_frames(request.settings)) {}

void PictureWork::find_kept() {
    const bool any = !files_.resume.empty() || !files_.checkpoint.empty() ||
                     std::filesystem::exists(part_path(request_.output)) || !rank_parts(request_.output).empty();
    if (resumable_ && any) {
        RenderOutcome outcome;
        outcome.maker = this_program();
        outcome.fingerprint = fingerprint();
        kept_ = find_kept_work(session_, request_, files_, render_metadata(request_, outcome));
    }
}

SampleRange PictureWork::wanted() const {
    const std::uint64_t first = first_sample(request_);
    return {first, request_.spp > 0 ? first + request_.spp : 0xffffffffU};
}

bool PictureWork::has_gap() const {
    return SampleRanges(wanted()).without(kept_.samples).ranges().size() > 1;
}

std::optional<ProgressiveTarget> PictureWork::target() const {
    const SampleRanges missing = SampleRanges(wanted()).without(kept_.samples);
    ProgressiveTarget target;
    target.seconds = request_.seconds > 0 ? request_.seconds - kept_.seconds : 0;
    if (missing.empty() || (request_.seconds > 0 && target.seconds <= 0)) {
        return std::nullopt;
    }
    const SampleRange next = missing.ranges().front();
    target.first = static_cast<std::uint32_t>(next.first);
    target.spp = static_cast<std::uint32_t>(next.end - next.first);
    if (has_gap()) {  // a gap that ranks have left is filled, whatever the limits
        target.seconds = 0;
        return target;
    }
    target.spp = request_.spp > 0 ? target.spp : 0;
    target.relmse = request_.target_error;
    if (kept_.look_at > 0) {
        target.look_at = kept_.look_at;
    }
    return target;
}

std::function<void(const Film&)> PictureWork::checkpoints() {
    if (checkpoint().empty()) {
        return {};
    }
    fingerprint();  // now, because the checkpoints are written in the background
    const Stopwatch watch;
    // Asked for now too, because a session that loses its device replaces its renderer.
    const std::string device = session_.renderer().device();
    const auto writer = std::make_shared<Checkpoints>(files_.every);
    return [this, watch, device, writer](const Film& film) {
        if (!writer->due()) {
            return;
        }
        writer->begin([this, watch, device, copy = film] {
            ProgressiveResult so_far;
            so_far.spp = samples_of_every_pixel(copy) - kept_.spp;
            so_far.seconds = watch.seconds();
            so_far.interrupted = true;
            save_sums(copy, outcome_of(so_far, copy, device), checkpoint());
        });
    };
}

void PictureWork::keep(const Film& film, const ProgressiveResult& result) {
    const std::uint64_t first = target()->first;
    kept_.samples.add({first, first + result.spp});
    kept_.spp += result.spp;
    kept_.seconds += result.seconds;
    merge_films(film, kept_.film);
}

std::shared_ptr<const Film> PictureWork::whole(std::shared_ptr<const Film> film) const {
    if (kept_.spp == 0) {
        return film;
    }
    const auto whole = std::make_shared<Film>(kept_.film);
    if (!film->pixels.empty()) {
        merge_films(*film, *whole);
    }
    return whole;
}

RenderOutcome PictureWork::outcome_of(const ProgressiveResult& result, const Film& film,
                                      const std::string& device) const {
    const std::optional<ProgressiveTarget> done = target();
    const std::uint64_t first = done ? done->first : wanted().end;
    SampleRanges samples = kept_.samples;
    samples.add({first, first + result.spp});
    RenderOutcome outcome = outcome_of(resumable_ ? samples : SampleRanges(), first + result.spp, film, device);
    outcome.spp = kept_.spp + result.spp;
    outcome.interrupted = result.interrupted;
    outcome.look_at = result.look_at > 0 ? result.look_at : kept_.look_at;
    outcome.seconds = kept_.seconds + result.seconds;
    return outcome;
}

RenderOutcome PictureWork::outcome_of(const SampleRanges& samples, std::uint64_t uneven_from, const Film& film,
                                      const std::string& device) const {
    const FilmTotals totals = film_totals(film);
    RenderOutcome outcome;
    outcome.maker = this_program();
    outcome.device = device;
    outcome.spp = static_cast<std::uint32_t>(samples.count());
    outcome.samples = samples;
    outcome.fingerprint = fingerprint_;
    outcome.uneven = totals.least < totals.most;
    outcome.uneven_from = uneven_from;
    outcome.rays = totals.rays;
    outcome.nonfinite = totals.nonfinite;
    return outcome;
}

SavedPicture PictureWork::save_sums(const Film& film, const RenderOutcome& outcome, const std::string& path) const {
    RenderRequest request = request_;
    request.output = path;
    request.sums = true;
    return save_picture(film, request, outcome, files_.fallback_folder);
}

void PictureWork::gather_kept() {
    const std::vector<std::string> parts = rank_parts(unfinished());
    const bool is_whole = kept_.paths.size() == 1 && std::count(parts.begin(), parts.end(), kept_.paths[0]) == 0;
    if (kept_.paths.empty() || is_whole) {
        return;
    }
    fingerprint();
    RenderOutcome outcome = outcome_of(kept_.samples, 0, kept_.film, session_.renderer().device());
    outcome.interrupted = true;
    outcome.look_at = kept_.look_at;
    outcome.seconds = kept_.seconds;
    if (!save_sums(kept_.film, outcome, unfinished()).fell_back) {
        remove_kept_parts(unfinished());
        kept_.paths = {unfinished()};
    }
}

/// Not files that the user has named.
void PictureWork::remove_kept_parts(const std::string& but) const {
    std::vector<std::string> ours = rank_parts(unfinished());
    for (const std::string& part : rank_parts(request_.output)) {
        ours.push_back(part);
    }
    ours.push_back(part_path(request_.output));
    for (const std::string& path : kept_.paths) {
        if (path != but && path != files_.resume && std::find(ours.begin(), ours.end(), path) != ours.end()) {
            std::filesystem::remove(path);
        }
    }
}

SavedPicture PictureWork::save(const Film& film, const RenderOutcome& outcome) {
    RenderRequest request = request_;
    if (outcome.interrupted) {
        request.output = unfinished_path(outcome);
        request.sums = resumable_;
    }
    RenderOutcome named = outcome;
    if (request.sums || !checkpoint().empty()) {
        named.fingerprint = fingerprint();
    }
    SavedPicture saved = save_picture(film, request, named, files_.fallback_folder);
    if (!checkpoint().empty() && checkpoint() != request.output) {
        request.output = checkpoint();
        request.sums = true;
        save_film(film, request, named);
    }
    if (!saved.fell_back) {
        remove_kept_parts(saved.path);  // all that they held is in the picture, or in the part
    }
    return saved;
}

const std::string& PictureWork::fingerprint() {
    if (fingerprint_.empty()) {
        fingerprint_ = scene_fingerprint(session_.packed());
    }
    return fingerprint_;
}

/// The checkpoint where one is kept, else a file beside the output; never one with more samples.
std::string PictureWork::unfinished_path(const RenderOutcome& outcome) const {
    if (!checkpoint().empty()) {
        return checkpoint();
    }
    const std::filesystem::path output(request_.output);
    std::string path = part_path(request_.output);
    for (int number = 2; samples_in(path) > outcome.spp && std::count(kept_.paths.begin(), kept_.paths.end(), path) == 0;
         ++number) {
        path = part_path((output.parent_path() / fmt::format("{}-{}.exr", output.stem().string(), number)).string());
    }
    return path;
}

}  // namespace diptych::core::app
