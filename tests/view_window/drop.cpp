// A source of XDND drops: what a file manager does when files are let go over a window. Version 5 of the protocol.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <algorithm>
#include <array>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "display.h"

namespace diptych::core::tests {

namespace {

class DropSource {
public:
    DropSource(Display* display, Window target, std::string uris)
        : display_(display), target_(target), uris_(std::move(uris)),
          source_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)) {}
    ~DropSource() { XDestroyWindow(display_, source_); }

    bool run() {
        XSetSelectionOwner(display_, atom("XdndSelection"), source_, CurrentTime);
        send("XdndEnter", {static_cast<long>(source_), 5L << 24U, static_cast<long>(atom("text/uri-list")), 0, 0});
        Window child = 0;
        int x = 0;
        int y = 0;
        XTranslateCoordinates(display_, target_, DefaultRootWindow(display_), 100, 100, &x, &y, &child);
        send("XdndPosition", {static_cast<long>(source_), 0, (static_cast<long>(x) << 16U) | y, CurrentTime,
                              static_cast<long>(atom("XdndActionCopy"))});
        const bool wanted = await(
            [&](const XEvent& event) { return is_message(event, "XdndStatus") && (event.xclient.data.l[1] & 1) != 0; });
        if (!wanted) {
            return false;
        }
        send("XdndDrop", {static_cast<long>(source_), 0, CurrentTime, 0, 0});
        return await([&](const XEvent& event) {
            if (event.type == SelectionRequest) {
                answer(event.xselectionrequest);
            }
            return is_message(event, "XdndFinished");
        });
    }

private:
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    bool is_message(const XEvent& event, const char* name) const {
        return event.type == ClientMessage && event.xclient.message_type == atom(name);
    }

    void send(const char* name, std::array<long, 5> data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(name);
        event.xclient.format = 32;
        std::copy(data.begin(), data.end(), event.xclient.data.l);
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    void answer(const XSelectionRequestEvent& asked) const {
        XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris_.data()), static_cast<int>(uris_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = asked.requestor;
        event.xselection.selection = asked.selection;
        event.xselection.target = asked.target;
        event.xselection.property = asked.property;
        event.xselection.time = asked.time;
        XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    bool await(const std::function<bool(const XEvent&)>& take) const {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (std::chrono::steady_clock::now() < deadline) {
            while (XPending(display_) > 0) {
                XEvent event;
                XNextEvent(display_, &event);
                if (take(event)) {
                    return true;
                }
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    Display* display_;
    Window target_;
    std::string uris_;
    Window source_;
};

}  // namespace

bool drop_files(const std::string& display, unsigned long window, const std::vector<std::string>& files) {
    const std::unique_ptr<Display, int (*)(Display*)> opened(XOpenDisplay(display.c_str()), XCloseDisplay);
    if (opened == nullptr) {
        return false;
    }
    std::string uris;
    for (const std::string& file : files) {
        uris += "file://" + file + "\r\n";
    }
    return DropSource(opened.get(), window, uris).run();
}

}  // namespace diptych::core::tests
