#include "window/view_window.h"

#include "commands/command.h"
#include "window/open_view.h"

namespace diptych::app {

int show_window(const WindowOptions& options, LoadedScene scene) {
    return OpenView(options, std::move(scene)).run() ? exit_interrupted : exit_done;
}

}  // namespace diptych::app
