#include "diptych/measure.h"

#include <fmt/format.h>

#include <mutex>

#include "backends/backends.h"
#include "image/image_file.h"
#include "image/layered_image.h"
#include "image/metrics.h"
#include "image/picture_name.h"
#include "library/impl.h"
#include "measure/replay.h"
#include "measure/verify_suite.h"

DIPTYCH_BEGIN

namespace {

core::SideName to_core(const Side& side) {
    core::SideName name;
    name.backend = core_name(side.backend);
    name.integrator = static_cast<core::Integrator>(side.integrator);
    return name;
}

Verdict verdict_of(const core::PairResult& pair, const core::TileGrid& grid) {
    const core::TileComparison& c = pair.comparison;
    Verdict out;
    out.verdict = static_cast<VerdictKind>(pair.verdict.verdict);
    out.reason = pair.verdict.reason;
    out.bias_percent = c.bias_percent;
    out.ci95 = (c.ci95_percent[1] - c.ci95_percent[0]) / 2;
    out.p = pair.verdict.adjusted_p;
    out.min_detectable_percent = pair.verdict.min_detectable_percent;
    out.tiles_x = grid.columns;
    out.tiles_y = grid.rows;
    for (const core::TileOutcome& tile : c.tiles) {
        const bool unequal = tile.state == core::ChannelState::unequal;
        const bool tested = tile.state == core::ChannelState::tested;
        out.p_values.push_back(tested ? tile.p : unequal ? 0 : std::numeric_limits<double>::quiet_NaN());
    }
    return out;
}

}  // namespace

core::RenderRequest measured_request(const core::Scene& content, const Settings& settings, const std::string& device,
                                     int threads) {
    core::RenderRequest request;
    request.scene = content.name;
    request.device = device;
    request.threads = threads;
    request.settings = to_core(settings);
    request.settings.standard_error = false;
    request.settings.first_hit_layers = false;
    return request;
}

core::Session open_measured(const core::Scene& scene, const core::RenderRequest& request, bool) {
    return {scene, request.settings, core::app::renderer_maker(request)};
}

static_assert(static_cast<int>(core::Verdict::inconclusive) == static_cast<int>(VerdictKind::inconclusive));

Verdict verify(const Scene& scene, const VerifyOptions& options) {
    return guarded([&] {
        const std::shared_ptr<const core::Scene> content = Impl::data(scene).snapshot();
        check(options.settings, content->cameras.size());
        if (options.runs < 3 || options.spp == 0 || options.tile < 1) {
            throw SettingError(fmt::format("verify: runs is {}, spp {}, tile {}; they have to be at least 3, 1 and 1",
                                           options.runs, options.spp, options.tile));
        }
        if (!(options.alpha > 0 && options.alpha < 1)) {
            throw SettingError(fmt::format("verify: alpha is {:g}; it has to lie between 0 and 1", options.alpha));
        }
        core::VerifySettings settings;
        settings.runs = options.runs;
        settings.spp = options.spp;
        settings.tile = options.tile;
        settings.alpha = options.alpha;
        settings.max_half_width = options.max_half_width;
        settings.max_tile_half_width = options.max_tile_half_width;
        core::RenderRequest request = measured_request(*content, options.settings, options.device, options.threads);
        request.spp = options.spp;
        const StopFlag stop(options.stop);
        std::mutex mutex;  // sides on different backends render at the same time
        std::uint32_t begun = 0;
        const std::optional<core::SuiteResult> suite =
            core::run_suite(settings, {*content, request, open_measured},
                            {{to_core(options.a), to_core(options.b), {}}}, options.settings.seed, stop.flag(),
                            [&](const core::SideName&, std::uint32_t) {
                                if (options.progress) {
                                    const std::lock_guard lock(mutex);
                                    options.progress(begun++, 2 * options.runs);
                                }
                            });
        if (!suite || suite->interrupted) {
            throw Interrupted("verify: stopped before all runs were done; there is no verdict");
        }
        return verdict_of(suite->pairs.front(), suite->grid);
    });
}

namespace {

Comparison comparison_of(const core::LayeredImage& a, const core::LayeredImage& b) {
    const core::Difference d = core::compare_images(a, b);
    return {d.mse, d.relmse, d.mean_ratio, d.z_mean, d.fraction_equal, d.nonfinite};
}

}  // namespace

Comparison compare(const Film& a, const Film& b) {
    return guarded([&] { return comparison_of(Impl::data(a).developed, Impl::data(b).developed); });
}

Comparison compare(const std::string& a, const std::string& b) {
    return guarded([&] {
        const auto read = [](const std::string& name) {
            const core::PictureName picture = core::picture_name(name);
            return core::read_image(picture.file, picture.layer);
        };
        return comparison_of(read(a), read(b));
    });
}

ReplayResult replay(Session& a, Session& b, const ReplayOptions& options) {
    return guarded([&] {
        core::Replay found;
        found.tolerance = options.tolerance;
        SessionData& first = Impl::data(a);
        for (Session* session : {&a, &b}) {
            SessionData& d = Impl::data(*session);
            d.follow_edits();
            if (d.settings != first.settings) {
                throw Error("replay: the sessions differ in settings");
            }
            if (!session->capabilities().replay) {
                throw Error("replay: backend " + name_of(d.choice.backend) + " keeps no record of its paths");
            }
            const std::array<int, 2>& size = d.settings.size;
            if (options.pixel[0] < 0 || options.pixel[0] >= size[0] || options.pixel[1] < 0 ||
                options.pixel[1] >= size[1]) {
                throw Error(fmt::format("replay: pixel {},{} lies outside {}x{}", options.pixel[0], options.pixel[1],
                                        size[0], size[1]));
            }
            const core::shared::PathQuery query{
                {static_cast<std::uint32_t>(options.pixel[0]), static_cast<std::uint32_t>(options.pixel[1])},
                options.sample};
            core::add_path(found, *d.session, query);
        }
        core::compare_paths(found);
        ReplayResult result;
        for (std::size_t side = 0; side < 2; ++side) {
            const core::RecordedPath& path = found.paths[side];
            result.radiance[side] = {path.radiance.x, path.radiance.y, path.radiance.z};
            for (const core::shared::PathVertexRecord& v : path.vertices) {
                const glm::dvec3 position = glm::dvec3(v.position) + found.origin;
                result.vertices[side].push_back({{position.x, position.y, position.z},
                                                 {v.emission.x, v.emission.y, v.emission.z},
                                                 {v.throughput.x, v.throughput.y, v.throughput.z}});
            }
        }
        if (found.parting) {
            result.parts_at = found.parting->vertex;
        }
        result.text = core::parting_text(found);
        return result;
    });
}

DIPTYCH_END
