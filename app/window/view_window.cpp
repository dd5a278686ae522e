#include "window/view_window.h"

#include "console/exit_codes.h"
#include "console/interrupt.h"
#include "window/open_view.h"

namespace diptych::core::app {

int show_window(const WindowOptions& options, LoadedScene scene) {
    return OpenView(options, std::move(scene)).run() ? interrupt_exit_code() : exit_done;
}

}  // namespace diptych::core::app
