#include "commands/render/kept_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "clock.h"
#include "console/report.h"
#include "error.h"
#include "image/layered_image.h"
#include "render/merge_films.h"

namespace diptych::core::app {

namespace {

/// The number of an entry; 0 where there is none.
template <class Number>
Number number_in(const Metadata& metadata, const std::string& name) {
    Number number = 0;
    if (const auto found = metadata.find(name); found != metadata.end()) {
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
    }
    return number;
}

std::uint32_t samples_of(const shared::FilmPixel& pixel) {
    return pixel.samples + pixel.nonfinite;
}

/// A run that was cut short leaves some pixels with samples that others lack. A pixel takes its samples in order, so its
/// count tells which it has.
void take_missing_samples(Session& session, std::uint32_t first, Film& film) {
    const auto [least, most] = std::minmax_element(
        film.pixels.begin(), film.pixels.end(),
        [](const shared::FilmPixel& a, const shared::FilmPixel& b) { return samples_of(a) < samples_of(b); });
    const std::uint32_t end = samples_of(*most);
    for (std::uint32_t sample = samples_of(*least); sample < end; ++sample) {
        session.render(first + sample, 1, std::atomic<bool>{false});
        Film more = session.film();
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            if (samples_of(film.pixels[i]) > sample) {
                more.pixels[i] = {};
                if (!more.moments.empty()) {
                    more.moments[i] = {};
                }
                if (!more.first_hits.empty()) {
                    more.first_hits[i] = {};
                }
            }
        }
        merge_films(more, film);
        session.restart(session.settings().seed);
    }
}

KeptWork work_of(Session& session, const RenderRequest& request, const std::string& path, FilmFile file) {
    const std::uint64_t first = request.samples ? request.samples->first : 0;
    const std::vector<SampleRange>& ranges = file.samples.ranges();
    if (ranges.size() != 1 || ranges[0].first != first) {
        throw Error(fmt::format("{}: holds samples {}, but this picture begins at sample {}", path,
                                ranges.empty() ? "none" : file.samples.text(), first));
    }
    KeptWork work;
    work.path = path;
    work.film = std::move(file.film);
    work.seconds = number_in<double>(file.metadata, "seconds");
    work.look_at = number_in<std::uint64_t>(file.metadata, "look_at");
    take_missing_samples(session, static_cast<std::uint32_t>(first), work.film);
    work.spp = samples_of(work.film.pixels.front());
    if (request.spp > 0 && work.spp > request.spp) {
        throw Error(fmt::format("{}: holds {} samples per pixel, more than the {} that are asked for", path, work.spp,
                                request.spp));
    }
    return work;
}

}  // namespace

std::string part_path(const std::string& output) {
    const std::filesystem::path path(output);
    return (path.parent_path() / path.stem()).string() + ".part.exr";
}

std::uint64_t samples_in(const std::string& path) {
    if (!std::filesystem::is_regular_file(path) || std::filesystem::path(path).extension() != ".exr") {
        return 0;
    }
    try {
        return number_in<std::uint64_t>(read_metadata(path), "spp");
    } catch (const Error&) {
        return 0;
    }
}

void refuse_to_lose(const RenderRequest& request, const WorkFiles& files) {
    const std::uint64_t spp = files.overwrite || request.spp == 0 ? 0 : samples_in(request.output);
    if (spp > request.spp) {
        throw Error(fmt::format("{}: is a picture of {} samples per pixel, and would be replaced by one of {}; give "
                                "--overwrite, or another -o",
                                request.output, spp, request.spp));
    }
}

KeptWork find_kept_work(Session& session, const RenderRequest& request, const WorkFiles& files, const Metadata& metadata) {
    if (files.overwrite && files.resume.empty()) {
        return {};
    }
    std::vector<std::string> paths = {files.resume};
    if (files.resume.empty()) {
        paths = {files.checkpoint, part_path(request.output)};
    }
    std::string found;
    std::optional<FilmFile> most;
    for (const std::string& path : paths) {
        // The first run of a job that is to go on from its own checkpoint has none yet.
        const bool may_lack = path.empty() || path != files.resume || path == files.checkpoint;
        if (may_lack && !std::filesystem::exists(path)) {
            continue;
        }
        std::optional<FilmFile> file = read_film(path);
        if (!file && path == part_path(request.output) && path != files.resume) {
            continue;  // a picture that cannot be gone on with
        }
        if (!file) {
            throw Error(fmt::format("{}: is a picture without the sums of its samples, which only parts and checkpoints "
                                    "hold",
                                    path));
        }
        if (const std::string difference = picture_difference(file->metadata, metadata); !difference.empty()) {
            throw Error(fmt::format("{}: holds samples of another picture: {}; --overwrite begins anew", path, difference));
        }
        if (!most || file->samples.count() > most->samples.count()) {
            found = path;
            most = std::move(file);
        }
    }
    return most ? work_of(session, request, found, std::move(*most)) : KeptWork{};
}

Checkpoints::Checkpoints(double every, std::function<void(const Film&)> write)
    : every_(every), next_(now_seconds() + every), write_(std::move(write)) {}

Checkpoints::~Checkpoints() {
    if (writing_.valid()) {
        writing_.wait();
    }
}

void Checkpoints::offer(const Film& film) {
    const bool busy = writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    if (busy || now_seconds() < next_) {
        return;
    }
    next_ = now_seconds() + every_;
    writing_ = std::async(std::launch::async, [this, copy = film] {
        try {
            write_(copy);
        } catch (const std::exception& error) {
            report_warning(fmt::format("{}; the render goes on", error.what()));
        }
    });
}

}  // namespace diptych::core::app
