#include "commands/render/rank_share.h"

#include "error.h"

namespace diptych::core::app {

namespace {

Film blank_film(const RenderSettings& settings) {
    Film film;
    film.width = settings.width;
    film.height = settings.height;
    film.pixels.resize(static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height));
    film.moments.resize(settings.standard_error ? film.pixels.size() : 0);
    film.first_hits.resize(settings.first_hit_layers ? film.pixels.size() : 0);
    return film;
}

}  // namespace

RankShare::RankShare(Team& team, Session& session, PictureWork& work, const WorkFiles& files, LossGuard& guard)
    : team_(team), session_(session), work_(work), guard_(guard), keeps_checkpoints_(!files.checkpoint.empty()),
      path_(rank_part_path(work.unfinished(), team.place().rank)), device_(session.renderer().device()),
      checkpoints_(files.every) {}

void RankShare::render(const SampleRange& block) {
    const auto first = static_cast<std::uint32_t>(block.first);
    const auto count = static_cast<std::uint32_t>(block.end - block.first);
    try {
        guard_.run(
            session_, team_.cancel(), [&] { session_.render(first, count, team_.cancel()); },
            [&] {
                finish_checkpoint();
                team_.tell_lost("its device was lost");
                samples_ = {};
            });
    } catch (const DeviceLost& error) {
        finish_checkpoint();
        gave_up_ = true;
        samples_ = {};
        team_.tell_gave_up(error.what());
        return;
    }
    if (team_.cancel()) {
        begun_ = block;
        return;
    }
    samples_.add(block);
    if (keeps_checkpoints_ && checkpoints_.due()) {
        Snapshot now = snapshot();
        now.film = std::make_shared<const Film>(*now.film);  // the renderer's own goes on growing
        checkpoints_.begin([this, now] { write(now, 0); });
    }
}

std::shared_ptr<const Film> RankShare::film() {
    if (!gave_up_) {
        try {
            return session_.renderer().film_in_place();
        } catch (const DeviceLost& error) {
            gave_up_ = true;
            samples_ = {};
            team_.tell_gave_up(error.what());
        }
    }
    return std::make_shared<const Film>(blank_film(session_.settings()));
}

RankShare::Snapshot RankShare::snapshot() {
    Snapshot now;
    now.film = film();
    now.samples = samples_;
    if (begun_ && !gave_up_) {
        const std::uint64_t whole = samples_of_every_pixel(*now.film) - samples_.count();
        now.uneven_from = begun_->first + whole;
        now.samples.add({begun_->first, now.uneven_from});
    }
    return now;
}

void RankShare::write(const Snapshot& snapshot, double seconds) const {
    RenderOutcome outcome = work_.outcome_of(snapshot.samples, snapshot.uneven_from, *snapshot.film, device_);
    outcome.interrupted = true;
    outcome.seconds = seconds;
    work_.save_sums(*snapshot.film, outcome, path_);
}

std::uint64_t RankShare::save(double seconds) {
    finish_checkpoint();
    const Snapshot now = snapshot();
    const FilmTotals totals = film_totals(*now.film);
    if (totals.samples + totals.nonfinite > 0) {
        write(now, seconds);
    }
    return now.samples.count();
}

}  // namespace diptych::core::app
