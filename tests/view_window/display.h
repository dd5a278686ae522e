// A display that nobody sees, and hands on it.
#pragma once

#include <string>
#include <vector>

namespace diptych::core::tests {

/// Whether the programs that these tests need are installed: Xvfb and xdotool.
bool has_virtual_display();

/// Xvfb, while it lives. It has no window manager.
class VirtualDisplay {
public:
    VirtualDisplay(int width, int height);
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// ":99", as DISPLAY has it; empty where Xvfb did not start.
    const std::string& name() const { return name_; }

    /// Runs `xdotool ARGUMENTS`; what it printed, without the last line break.
    std::string hand(const std::vector<std::string>& arguments) const;

private:
    std::string name_;
    int child_ = -1;
};

/// Drags files onto a window from another program and lets go of them, by the XDND protocol; true where the window took
/// them.
bool drop_files(const std::string& display, unsigned long window, const std::vector<std::string>& files);

}  // namespace diptych::core::tests
