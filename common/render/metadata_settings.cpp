// The settings that a picture's metadata tell: render_metadata's inverse.
#include <fmt/format.h>

#include <charconv>

#include "error.h"
#include "render/metadata.h"
#include "settings/names.h"
#include "settings/ranges.h"

namespace diptych::core {

namespace {

class Entries {
public:
    explicit Entries(const std::map<std::string, std::string>& metadata) : metadata_(metadata) {}

    /// Each leaves the value where there is no such entry, or an empty one.
    template <class Number>
    void number(const std::string& name, Number& value) const {
        const std::string* text = find(name);
        if (text == nullptr) {
            return;
        }
        const char* const end = text->data() + text->size();
        const auto [stop, failure] = std::from_chars(text->data(), end, value);
        if (failure != std::errc() || stop != end) {
            throw Error(fmt::format("its metadata {} is '{}', not a number in range", name, text->substr(0, 40)));
        }
    }
    template <class Number>
    void number(const SettingRange& range, Number& value) const {
        number(key_of(range.name), value);
    }
    void flag(const std::string& name, bool& value) const {
        if (const std::string* text = find(name)) {
            value = *text == "yes" || *text == "true";
        }
    }
    template <class Choice>
    void choice(const std::string& name, Choice& value, Choice (*from_name)(const std::string&)) const {
        if (const std::string* text = find(name)) {
            value = from_name(*text);
        }
    }

private:
    const std::string* find(const std::string& name) const {
        const auto found = metadata_.find(name);
        return found == metadata_.end() || found->second.empty() ? nullptr : &found->second;
    }

    const std::map<std::string, std::string>& metadata_;
};

}  // namespace

RenderSettings settings_in(const std::map<std::string, std::string>& metadata) {
    const Entries entries(metadata);
    RenderSettings settings;
    entries.number("width", settings.width);
    entries.number("height", settings.height);
    entries.choice("integrator", settings.integrator, integrator_from_name);
    entries.choice("brdf", settings.brdf, brdf_from_name);
    entries.choice("normal_maps", settings.normal_maps, normal_maps_from_name);
    entries.choice("sampler", settings.sampler, sampler_from_name);
    entries.choice("mis", settings.mis, mis_from_name);
    settings.light_sampler = LightSampler::power;  // of pictures that are older than the setting
    entries.choice("light_sampler", settings.light_sampler, light_sampler_from_name);
    entries.number(ranges::max_depth, settings.max_depth);
    entries.number("seed", settings.seed);
    entries.number("sample_count", settings.sample_count);
    entries.number("camera_index", settings.camera);
    entries.flag("standard_error", settings.standard_error);
    entries.flag("first_hit_layers", settings.first_hit_layers);
    entries.flag("generic", settings.generic);
    entries.number("atlas", settings.atlas_tile);
    ResamplingSettings& resampling = settings.resampling;
    entries.number(ranges::candidates, resampling.light_candidates);
    entries.number(ranges::near_share, resampling.near_share);
    entries.flag("bsdf_candidate", resampling.bsdf_candidate);
    entries.flag("temporal", resampling.temporal);
    entries.number(ranges::spatial_passes, resampling.spatial_passes);
    entries.number(ranges::neighbors, resampling.neighbors);
    entries.number(ranges::reuse_radius, resampling.radius);
    entries.number(ranges::confidence_cap, resampling.confidence_cap);
    entries.choice("reuse_mis", resampling.mis, resampling_mis_from_name);
    entries.choice("reuse_visibility", resampling.visibility, resampling_visibility_from_name);
    return settings;
}

}  // namespace diptych::core
