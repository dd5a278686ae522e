// Films to and from files.
#include <fmt/format.h>

#include <charconv>

#include "diptych/film.h"
#include "image/image_file.h"
#include "library/impl.h"
#include "render/save_film.h"

DIPTYCH_BEGIN

namespace {

std::string entry(const core::Metadata& metadata, const std::string& name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? "" : found->second;
}

/// Of a picture of this project; any other has no such entries. Totals are the film's where there is one.
FilmInfo info_of(const std::string& path, const FilmData& data) {
    FilmInfo info;
    info.file = path;
    info.scene = entry(data.metadata, "scene");
    const std::string backend = entry(data.metadata, "backend");
    info.backend = backend.empty() ? Backend::cpu : backend_from(backend);
    info.device = entry(data.metadata, "device");
    info.settings = from_core(core::settings_in(data.metadata));
    info.settings.size = {data.developed.color.width, data.developed.color.height};
    info.settings.standard_error = data.developed.standard_error.has_value();
    info.settings.first_hit = data.developed.albedo.has_value();
    const auto number = [&](const char* name, auto& value) {
        const std::string text = entry(data.metadata, name);
        std::from_chars(text.data(), text.data() + text.size(), value);
    };
    number("spp", info.spp);
    number("seconds", info.seconds);
    number("rays", info.rays);
    number("nonfinite", info.nonfinite);
    const core::FilmTotals totals = core::film_totals(data.film);
    info.samples = totals.samples;
    return info;
}

}  // namespace

Film Film::load(const std::string& path, std::uint64_t memory_limit) {
    return guarded([&] {
        auto data = std::make_shared<FilmData>();
        if (std::optional<core::FilmFile> file = core::read_film(path, memory_limit)) {
            data->film = std::move(file->film);
            data->metadata = std::move(file->metadata);
            data->developed = core::develop(data->film);
            data->samples = {{0, {path, std::move(file->samples)}}};
        } else {
            data->developed = core::read_image(path, "", memory_limit);
            data->metadata = data->developed.metadata;
            data->film.width = data->developed.color.width;
            data->film.height = data->developed.color.height;
        }
        try {
            data->info = info_of(path, *data);
        } catch (const std::runtime_error& error) {
            throw Error(path + ": " + error.what());
        }
        for (FilmSamples& samples : data->samples) {
            samples.seed = data->info.settings.seed;
        }
        return Film(std::move(data));
    });
}

namespace {

core::Metadata metadata_of(const FilmData& data, bool sums) {
    core::Metadata metadata = data.metadata;
    core::SampleRanges samples;
    for (const FilmSamples& each : data.samples) {
        if (sums && each.seed != data.samples.front().seed) {
            throw Error(fmt::format("{}: has samples of seeds {} and {}, and sums in a file are of one seed; save the "
                                    "films before they are merged",
                                    data.name(), data.samples.front().seed, each.seed));
        }
        if (each.seed == data.samples.front().seed && !data.chained()) {
            samples.add(each.part.samples);
        }
    }
    if (data.samples.size() > 1) {
        core::count_anew(data.film, samples, metadata);
        metadata["spp"] = fmt::format("{}", data.info.spp);
        metadata["seconds"] = fmt::format("{}", data.info.seconds);
    }
    return metadata;
}

}  // namespace

void Film::save(const std::string& path, const SaveOptions& options) const {
    guarded([&] {
        core::check_writable(path);
        if (options.sums && !has_sums()) {
            throw Error(fmt::format("{}: has no sums to save: it was a picture without them", data_->name()));
        }
        if (options.sums && core::image_format(path) != core::ImageFormat::Exr) {
            throw Error(fmt::format("{}: cannot hold the sums of its samples; only .exr can", path));
        }
        const core::Metadata metadata = metadata_of(*data_, options.sums);
        const core::RenderRequest shown = core::shown_by(metadata, options.sums);
        if (has_sums()) {
            core::write_film(data_->film, metadata, shown, path);
            return;
        }
        core::LayeredImage picture = data_->developed;
        picture.metadata = metadata;
        core::write_picture(picture, shown, path);
    });
}

DIPTYCH_END
