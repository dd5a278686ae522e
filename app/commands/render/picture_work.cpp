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

/// Some pixels have more samples than others.
bool is_uneven(const Film& film) {
    const auto count = [](const shared::FilmPixel& pixel) { return pixel.samples + pixel.nonfinite; };
    return std::any_of(film.pixels.begin(), film.pixels.end(),
                       [&](const shared::FilmPixel& pixel) { return count(pixel) != count(film.pixels.front()); });
}

std::uint32_t first_sample(const RenderRequest& request) {
    return request.samples ? static_cast<std::uint32_t>(request.samples->first) : 0;
}

}  // namespace

PictureWork::PictureWork(Session& session, const RenderRequest& request, const WorkFiles& files)
    : session_(session), request_(request), files_(files),
      resumable_(request.backend == "oracle" || !chains_frames(request.settings)) {}

void PictureWork::find_kept() {
    const bool any = !files_.resume.empty() || !files_.checkpoint.empty() ||
                     std::filesystem::exists(part_path(request_.output));
    if (resumable_ && any) {
        RenderOutcome outcome;
        outcome.maker = this_program();
        outcome.fingerprint = fingerprint();
        kept_ = find_kept_work(session_, request_, files_, render_metadata(request_, outcome));
    }
}

std::optional<ProgressiveTarget> PictureWork::target() const {
    ProgressiveTarget target;
    target.first = first_sample(request_) + kept_.spp;
    target.spp = request_.spp > 0 ? request_.spp - kept_.spp : 0;
    target.seconds = request_.seconds > 0 ? request_.seconds - kept_.seconds : 0;
    target.relmse = request_.target_error;
    if (kept_.look_at > 0) {
        target.look_at = kept_.look_at;
    }
    const bool done = (request_.spp > 0 && target.spp == 0) || (request_.seconds > 0 && target.seconds <= 0);
    return done ? std::nullopt : std::optional(target);
}

std::function<void(const Film&)> PictureWork::checkpoints() {
    if (checkpoint().empty()) {
        return {};
    }
    fingerprint();  // now, because the checkpoints are written in the background
    const Stopwatch watch;
    // Asked for now too, because a session that loses its device replaces its renderer.
    const std::string device = session_.renderer().device();
    const auto writer = std::make_shared<Checkpoints>(files_.every, [this, watch, device](const Film& film) {
        ProgressiveResult so_far;
        so_far.spp = samples_of_every_pixel(film) - kept_.spp;
        so_far.seconds = watch.seconds();
        so_far.interrupted = true;
        RenderRequest request = request_;
        request.output = checkpoint();
        request.sums = true;
        save_film(film, request, outcome_of(so_far, film, device));
    });
    return [writer](const Film& film) { writer->offer(film); };
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
    const FilmTotals totals = film_totals(film);
    const std::uint64_t first = first_sample(request_);
    RenderOutcome outcome;
    outcome.maker = this_program();
    outcome.device = device;
    outcome.spp = kept_.spp + result.spp;
    outcome.samples = resumable_ ? SampleRanges({first, first + outcome.spp}) : SampleRanges();
    outcome.fingerprint = fingerprint_;
    outcome.interrupted = result.interrupted;
    outcome.uneven = is_uneven(film);
    outcome.look_at = result.look_at > 0 ? result.look_at : kept_.look_at;
    outcome.seconds = kept_.seconds + result.seconds;
    outcome.rays = totals.rays;
    outcome.nonfinite = totals.nonfinite;
    return outcome;
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
    if (!outcome.interrupted && !saved.fell_back && kept_.path == part_path(request_.output)) {
        std::filesystem::remove(kept_.path);  // all that it held is in the picture
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
    for (int number = 2; samples_in(path) > outcome.spp && path != kept_.path; ++number) {
        path = part_path((output.parent_path() / fmt::format("{}-{}.exr", output.stem().string(), number)).string());
    }
    return path;
}

}  // namespace diptych::core::app
