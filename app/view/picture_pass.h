// The picture of a view on a device that shows nothing.
#pragma once

#include <memory>

#include "image/image.h"
#include "pack/packed_scene.h"
#include "view/panel_worker.h"

namespace diptych::core::app {

class PicturePass {
public:
    /// Opens the request's device. Throws NoDevice where there is none, or where the program was built without Vulkan.
    explicit PicturePass(const RenderRequest& request);
    ~PicturePass();
    PicturePass(const PicturePass&) = delete;
    PicturePass& operator=(const PicturePass&) = delete;

    /// Renderers on this device.
    RendererFactory factory() const;

    /// Puts what is shown on the picture, and waits for it. A panel that is not shown is null.
    void draw(const ShownState& shown, const PanelShot* cpu, const PanelShot* vulkan, int width, int height);

    /// What was drawn last: display values, 3 channels.
    Image picture() const;

private:
    struct Device;
    std::unique_ptr<Device> device_;
};

}  // namespace diptych::core::app
