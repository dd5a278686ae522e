// A picture that outlasts the loss of its device.
#pragma once

#include "render/device_loss.h"
#include "render/renderer.h"

namespace diptych::core {

/// The picture of a session as a renderer. After a loss the session is renewed, and the samples go on from the film
/// that was read last, to which they are added. Frames of restir depend on the frames before, so there the picture begins
/// anew. Either way the same samples are drawn as without a loss.
class LastingPicture final : public Renderer {
public:
    /// The session stands before sample `first`, the first that it is asked for. `begin` brings a renewed session of
    /// restir there, history included. All of these must live as long.
    LastingPicture(Session& session, LossGuard& guard, const std::atomic<bool>& cancel, std::function<void()> begin,
                   std::uint32_t first = 0);

    std::string backend() const override { return session_.renderer().backend(); }
    /// All devices that the picture's samples are from.
    std::string device() const override { return devices_; }
    RendererCosts costs() const override { return session_.renderer().costs(); }
    Capabilities capabilities() const override { return session_.renderer().capabilities(); }
    /// Samples are taken in rising order, without gaps. Throws DeviceLost where the guard does.
    void render(std::uint32_t first, std::uint32_t count, const std::atomic<bool>& cancel) override;
    void restart(std::uint32_t) override { refuse(); }
    void move_to(const PackedScene&) override { refuse(); }
    double device_seconds() const override { return lost_seconds_ + session_.renderer().device_seconds(); }
    Film film() const override;
    /// The film, of which no copy is kept.
    Film take_film();
    TraversalBench bench_traversal(std::uint32_t) override { refuse(); }

    /// What is left after a loss that was the end: the film that was read last, and how many samples a pixel were
    /// rendered after it.
    const Film& kept() const { return kept_; }
    std::uint32_t kept_samples() const { return kept_end_ - first_; }
    std::uint32_t lost_samples() const { return end_ - kept_end_; }

private:
    [[noreturn]] static void refuse() { throw Error("a lasting picture is only rendered"); }
    void read() const;
    void outlast(const std::function<void()>& work) const;
    void go_on_after_loss() const;
    void render_missing(const std::atomic<bool>& cancel) const;

    // A film is read from a picture that stays as it is, but reading it may renew the session.
    Session& session_;
    LossGuard& guard_;
    const std::atomic<bool>& cancel_;
    std::function<void()> begin_;
    std::uint32_t first_;
    mutable std::uint32_t next_;  // sample of the session's renderer
    std::uint32_t end_;           // of the samples that were asked for
    mutable Film base_;               // of the renderers before; empty if there were none
    mutable Film kept_;               // the last that was read, base included
    mutable std::uint32_t kept_end_;
    mutable std::string last_device_;
    mutable std::string devices_;
    mutable double lost_seconds_ = 0;
};

}  // namespace diptych::core
