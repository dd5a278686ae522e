#include "render/save_film.h"

#include "image/image_file.h"
#include "image/tonemap_image.h"

namespace diptych::core {

namespace {

void save(const RenderRequest& request, const LayeredImage& layers) {
    switch (image_format(request.output)) {
    case ImageFormat::Exr:
        write_exr(request.output, layers);
        break;
    case ImageFormat::Png:
        write_png(request.output,
                  tonemapped(layers.color, tonemap_from_name(request.tonemap), static_cast<float>(request.exposure)));
        break;
    case ImageFormat::Hdr:
        write_hdr(request.output, layers.color);
        break;
    }
}

}  // namespace

LayeredImage save_film(const Film& film, const RenderRequest& request, const RenderOutcome& outcome) {
    LayeredImage layers = develop(film);
    layers.metadata = render_metadata(request, outcome);
    save(request, layers);
    return layers;
}

}  // namespace diptych::core
