#include "session/make_renderer.h"

#include <fmt/format.h>

#include <utility>

#include "console/exit_codes.h"
#include "console/report.h"

namespace diptych::core::app {

namespace {

RendererMaker& replacement() {
    static RendererMaker maker;
    return maker;
}

}  // namespace

void replace_renderers(RendererMaker maker) {
    replacement() = std::move(maker);
}

std::unique_ptr<Renderer> make_renderer(const Scene& scene, const PackedScene& packed, const RenderRequest& request,
                                        const BusyHook& busy) {
    return replacement() ? replacement()(scene, packed, request) : open_renderer(scene, packed, request, busy);
}

MakeRenderer renderer_maker_of(const RenderRequest& request, BusyHook busy) {
    return [request, busy = std::move(busy)](const Scene& scene, const PackedScene& packed, const RenderSettings& settings) {
        RenderRequest asked = request;
        asked.settings = settings;
        return make_renderer(scene, packed, asked, busy);
    };
}

int exit_code_after_validation(int exit_code) {
    if (const std::uint64_t count = close_devices(); count > 0) {
        report_error(fmt::format("validation: the layer had {} message{}", count, count == 1 ? "" : "s"));
        return exit_code == exit_done ? exit_check_failed : exit_code;
    }
    return exit_code;
}

}  // namespace diptych::core::app
