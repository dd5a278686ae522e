#include "commands/render/kept_work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "clock.h"
#include "console/report.h"
#include "error.h"
#include "image/layered_image.h"
#include "memory_budget.h"
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
/// count tells which it has of those from `first` on; `even` samples each pixel has. Returns the end of the samples that
/// all have then.
std::uint32_t take_missing_samples(Session& session, std::uint32_t first, std::uint32_t even, Film& film) {
    std::uint32_t most = even;
    for (const shared::FilmPixel& pixel : film.pixels) {
        most = std::max(most, samples_of(pixel));
    }
    for (std::uint32_t sample = even; sample < most; ++sample) {
        session.render(first + sample - even, 1, std::atomic<bool>{false});
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
    return first + most - even;
}

/// A file that may hold samples of the picture, as its metadata have it.
struct Candidate {
    std::string path;
    SampleRanges samples;
};

/// Adds the samples of a file, which has none in common with those.
void take_file(Session& session, const RenderRequest& request, const Candidate& candidate, KeptWork& work) {
    std::optional<FilmFile> file = read_film(candidate.path, kept_film_limit(request));
    if (!file) {
        throw Error(fmt::format("{}: is a picture without the sums of its samples, which only parts and checkpoints hold",
                                candidate.path));
    }
    const std::vector<SampleRange>& ranges = file->samples.ranges();
    const std::uint64_t first = request.samples ? request.samples->first : 0;
    const std::uint64_t last = ranges.empty() ? first : ranges.back().end;
    const auto entry = file->metadata.find("uneven_from");
    const bool says_where = entry != file->metadata.end() && !entry->second.empty();
    const std::uint64_t from = says_where ? number_in<std::uint64_t>(file->metadata, "uneven_from") : last;
    const auto even = static_cast<std::uint32_t>(file->samples.count());
    const std::uint32_t end = take_missing_samples(session, static_cast<std::uint32_t>(from), even, file->film);
    const SampleRanges taken(SampleRange{from, end});
    if (work.samples.shared_with(taken) || file->samples.shared_with(taken)) {
        throw Error(fmt::format("{}: holds samples that another file holds too", candidate.path));
    }
    file->samples.add(taken);
    work.paths.push_back(candidate.path);
    work.samples.add(file->samples);
    if (work.film.pixels.empty()) {
        work.film = std::move(file->film);
    } else {
        merge_films(file->film, work.film);
    }
    work.seconds += number_in<double>(file->metadata, "seconds");
    work.look_at = std::max(work.look_at, number_in<std::uint64_t>(file->metadata, "look_at"));
}

/// Files to go on from that are there: those that were named or are looked for, and parts of ranks beside them.
std::vector<std::string> candidate_paths(const RenderRequest& request, const WorkFiles& files) {
    std::vector<std::string> named = {files.resume};
    if (files.resume.empty()) {
        named = {files.checkpoint, part_path(request.output)};
    }
    std::vector<std::string> paths;
    for (const std::string& path : named) {
        const std::vector<std::string> parts = path.empty() ? std::vector<std::string>() : rank_parts(path);
        // The first run of a job that is to go on from its own checkpoint has none yet.
        const bool may_lack = path.empty() || path != files.resume || path == files.checkpoint || !parts.empty();
        if (!may_lack || std::filesystem::exists(path)) {
            paths.push_back(path);
        }
        for (const std::string& part : parts) {
            if (std::find(paths.begin(), paths.end(), part) == paths.end()) {
                paths.push_back(part);
            }
        }
    }
    return paths;
}

}  // namespace

std::string part_path(const std::string& output) {
    const std::filesystem::path path(output);
    return (path.parent_path() / path.stem()).string() + ".part.exr";
}

std::string rank_part_path(const std::string& path, int rank) {
    std::filesystem::path stem = std::filesystem::path(path).replace_extension();
    if (stem.extension() == ".part") {
        stem.replace_extension();
    }
    return fmt::format("{}.rank{}.part.exr", stem.string(), rank);
}

std::uint64_t kept_film_limit(const RenderRequest& request) {
    if (request.memory_limit > 0) {
        return request.memory_limit;
    }
    const RenderSettings& settings = request.settings;
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height);
    return std::max(default_memory_limit(), film_bytes(pixels, settings.standard_error, settings.first_hit_layers));
}

std::vector<std::string> rank_parts(const std::string& path) {
    const std::filesystem::path sample(rank_part_path(path, 0));
    const std::string name = sample.filename().string();
    const std::string start = name.substr(0, name.size() - std::string_view("0.part.exr").size());
    const std::filesystem::path folder = sample.parent_path().empty() ? "." : sample.parent_path();
    std::vector<std::string> parts;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const std::string other = entry.path().filename().string();
        if (!other.starts_with(start) || !other.ends_with(".part.exr")) {
            continue;
        }
        const std::string number = other.substr(start.size(), other.size() - start.size() - 9);
        if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos) {
            parts.push_back((sample.parent_path() / other).string());
        }
    }
    std::sort(parts.begin(), parts.end());
    return parts;
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
    std::vector<Candidate> candidates;
    for (const std::string& path : candidate_paths(request, files)) {
        Metadata found = read_metadata(path);
        const bool has_sums = take_film_entries(found);
        if (!has_sums && path == part_path(request.output) && path != files.resume) {
            continue;  // a picture that cannot be gone on with
        }
        if (const std::string difference = picture_difference(found, metadata);
            has_sums && !difference.empty()) {
            throw Error(fmt::format("{}: holds samples of another picture: {}; --overwrite begins anew", path, difference));
        }
        try {
            candidates.push_back({path, SampleRanges::parse(found["samples"])});
        } catch (const Error& error) {
            throw Error(fmt::format("{}: cannot read its film: {}", path, error.what()));
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.samples.count() > b.samples.count(); });
    KeptWork work;
    for (const Candidate& candidate : candidates) {
        // A run that was killed while it put parts together leaves both these and the whole.
        if (!work.samples.shared_with(candidate.samples)) {
            take_file(session, request, candidate, work);
        }
    }
    if (work.paths.empty()) {
        return work;
    }
    work.spp = static_cast<std::uint32_t>(work.samples.count());
    const std::uint64_t first = request.samples ? request.samples->first : 0;
    const std::uint64_t end = request.spp > 0 ? first + request.spp : 0xffffffffU;
    const SampleRanges foreign = work.samples.without(SampleRanges({first, end}));
    if (request.spp > 0 && work.spp > request.spp) {
        throw Error(fmt::format("{}: holds {} samples per pixel, more than the {} that are asked for",
                                fmt::join(work.paths, ", "), work.spp, request.spp));
    }
    if (!foreign.empty()) {
        throw Error(fmt::format("{}: holds samples {}, but this picture has the samples {}", fmt::join(work.paths, ", "),
                                work.samples.text(), range_text({first, end})));
    }
    return work;
}

Checkpoints::Checkpoints(double every) : every_(every), next_(now_seconds() + every) {}

Checkpoints::~Checkpoints() {
    finish();
}

void Checkpoints::finish() {
    if (writing_.valid()) {
        writing_.wait();
    }
}

bool Checkpoints::due() const {
    const bool busy = writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    return !busy && now_seconds() >= next_;
}

void Checkpoints::begin(std::function<void()> write) {
    next_ = now_seconds() + every_;
    writing_ = std::async(std::launch::async, [write = std::move(write)] {
        try {
            write();
        } catch (const std::exception& error) {
            report_warning(fmt::format("{}; the render goes on", error.what()));
        }
    });
}

}  // namespace diptych::core::app
