#include "commands/render/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands/command.h"
#include "commands/render/picture.h"
#include "commands/render/rank_run.h"
#include "console/interrupt.h"
#include "console/opening_line.h"
#include "console/repeat_command.h"
#include "error.h"
#include "image/layered_image.h"
#include "pack/fingerprint.h"
#include "render/film_file.h"
#include "render/metadata.h"
#include "render/frames.h"
#include "render/seeds.h"
#include "session/open_session.h"
#include "console/report.h"

namespace diptych::core::app {

std::string frame_path(const std::string& output, std::uint32_t frame, std::uint32_t frames) {
    const std::size_t name = output.find_last_of('/') == std::string::npos ? 0 : output.find_last_of('/') + 1;
    const std::size_t last = output.find_last_of('#');
    if (last != std::string::npos && last >= name && frames > 0) {
        std::size_t first = last;
        while (first > name && output[first - 1] == '#') {
            --first;
        }
        return output.substr(0, first) + fmt::format("{:0{}}", frame, last - first + 1) + output.substr(last + 1);
    }
    if (frames <= 1) {
        return output;
    }
    const std::size_t dot = output.find_last_of('.');
    const std::size_t end = dot == std::string::npos || dot <= name ? output.size() : dot;
    return output.substr(0, end) + fmt::format(".{:04}", frame) + output.substr(end);
}

namespace {

/// One frame as a picture of its own, whose command renders it alone. `chain_start` is the frame, kept or not, with which
/// frames that go on from one another begin.
RenderRequest frame_request(const RenderRequest& request, std::uint32_t moment, bool chained, std::uint32_t chain_start) {
    RenderRequest frame = request;
    if (chained) {
        frame.start = request.start + chain_start / request.fps;
        frame.warm_up = moment - chain_start;
    } else {
        frame.start = request.start + moment / request.fps;
        frame.settings.seed = neighbor_seed(request.settings.seed, moment);
    }
    frame.frame = moment - request.warm_up;
    frame.output = frame_path(request.output, frame.frame, request.frames);
    frame.frames = 1;
    return frame;
}

/// Whether the frame's file is there, whole, with its samples. Throws Error where it is a frame of another picture.
bool is_finished(const RenderRequest& frame) {
    if (!std::filesystem::exists(frame.output)) {
        return false;
    }
    if (image_format(frame.output) != ImageFormat::Exr) {
        return true;
    }
    if (samples_in(frame.output) < frame.spp) {
        return false;
    }
    std::map<std::string, std::string> found = read_metadata(frame.output);
    RenderOutcome outcome;
    outcome.maker = this_program();
    std::map<std::string, std::string> wanted = render_metadata(frame, outcome);
    for (const char* name : {"warm_up", "program", "frame"}) {  // what may differ between runs of one sequence
        found.erase(name);
        wanted.erase(name);
    }
    found.erase("fingerprint");
    if (const std::string difference = picture_difference(found, wanted); !difference.empty()) {
        throw Error(fmt::format("{}: is a frame of another picture: {}; give --overwrite, or another -o", frame.output,
                                difference));
    }
    return true;
}

std::string frame_label(const RenderRequest& frame, std::uint32_t frames) {
    return fmt::format("frame {}/{}  ", frame.frame + 1, frames);
}

/// Frames that stand alone, in an order that rank 0 gives. `render` returns the picture of a frame.
int render_frames_on_ranks(RankRun& run, const SampleRanges& unfinished, const std::string& identity,
                           const std::string& device, bool json, const std::function<Picture(std::uint32_t)>& render) {
    Team& team = run.team();
    if (run.leads()) {
        Work work;
        work.wanted = unfinished;
        work.limits.most_units = 1;
        work.merges = false;
        work.unit = "frames";
        work.picture = identity;
        team.start(std::move(work));
    }
    team.ready({identity, device});
    for (;;) {
        const Order order = team.next();
        if (order.kind == Order::Kind::render) {
            const Picture picture = render(static_cast<std::uint32_t>(order.block.first));
            if (picture.saved) {
                run.report(json ? "" : picture.line, picture.json, picture_exit_code(picture));
            }
            continue;
        }
        int code = order.code;
        if (order.kind == Order::Kind::stop) {
            team.tell_saved(0);
            code = run.leads() ? team.wait_for_saved().code : code;
        }
        if (run.leads()) {
            RankRun::Results results = run.results();
            std::sort(results.json.begin(), results.json.end(),
                      [](const auto& a, const auto& b) { return a["frame"] < b["frame"]; });
            if (json) {
                print_json(results.json);
            }
            code = code == exit_done ? results.exit_code : code;
        }
        return code;
    }
}

}  // namespace

int render_sequence(const Scene& scene, const RenderRequest& request, const SequenceOptions& options) {
    const FrameMoments moments(scene, request);
    LossGuard guard(options.on_device_lost);
    OpeningLine opening(options.json);
    Session session = guard.open([&](const MakeRenderer& instead) {
        return open_played(scene, request, instead, [&](const std::string& what) { opening.begin(what); });
    });
    opening.close();
    const bool chained = session.chained();
    const std::uint32_t first = options.first_frame;
    std::vector<bool> finished(request.frames);
    const bool decides = options.run == nullptr || options.run->leads();
    for (std::uint32_t frame = decides ? first : request.frames; frame < request.frames; ++frame) {
        finished[frame] =
            !options.files.overwrite && is_finished(frame_request(request, request.warm_up + frame, chained, first));
    }
    const auto unfinished = std::find(finished.begin() + first, finished.end(), false);
    const auto next = static_cast<std::uint32_t>(unfinished - finished.begin());
    if (next > first) {
        report_warning(fmt::format("{}: {} finished frames are left alone; --overwrite renders them again", request.output,
                                   std::count(finished.begin() + first, finished.end(), true)));
    }
    // Warm-up frames stand for all that a chain looks back to. Without them it begins at its first frame again.
    const std::uint32_t start = !chained || request.warm_up > 0 ? next : first;
    if (start < next && next < request.frames) {
        report_warning(fmt::format("frames {} to {} are rendered again, because restir goes on from them; --warm-up "
                                   "begins that many frames earlier instead",
                                   start, next - 1));
    }
    if (options.run != nullptr) {
        SampleRanges unfinished_frames;
        for (std::uint32_t frame = first; frame < request.frames; ++frame) {
            unfinished_frames.add({frame, frame + (finished[frame] ? 0U : 1U)});
        }
        RenderOutcome outcome;
        outcome.maker.program = program_version();
        outcome.fingerprint = scene_fingerprint(session.packed());
        const std::atomic<bool>& cancel = options.run->team().cancel();
        return render_frames_on_ranks(
            *options.run, unfinished_frames, picture_identity(render_metadata(request, outcome)),
            session.renderer().device(), options.json, [&](std::uint32_t i) {
                const RenderRequest frame = frame_request(request, i, false, first);
                const auto show = [&] { session.show(moments.at(i), frame.settings.seed); };
                guard.run(session, cancel, show);
                Picture picture = render_picture(session, frame, cancel,
                                                 {.label = frame_label(frame, request.frames), .quiet = true, .live = nullptr},
                                                 options.files, guard, show);
                picture.json["pack_seconds"] = session.pack_seconds();
                picture.json["move_seconds"] = session.move_seconds();
                return picture;
            });
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    InterruptGuard interrupt;
    const auto show = [&](std::uint32_t frame) {
        const std::uint32_t seed = frame_request(request, frame, chained, start).settings.seed;
        session.show(moments.at(frame), chained && frame > start ? std::nullopt : std::optional(seed));
    };
    // A session that was renewed has no history: the frames that led to this one are rendered anew.
    const auto begin_anew = [&](std::uint32_t frame) {
        for (std::uint32_t i = chained ? start : frame; i < frame && !interrupt.requested(); ++i) {
            show(i);
            session.render(0, request.spp, interrupt.requested());
        }
        show(frame);
    };
    int exit_code = exit_done;
    const std::uint32_t end = next < request.frames ? request.warm_up + request.frames : start;
    for (std::uint32_t i = start; i < end && (exit_code == exit_done || exit_code == exit_bad_input); ++i) {
        const RenderRequest frame = frame_request(request, i, chained, start);
        const bool kept = i >= start + request.warm_up && !finished[frame.frame];
        if (!kept && !chained) {
            continue;
        }
        bool renewed = false;
        guard.run(
            session, interrupt.requested(),
            [&] {
                renewed ? begin_anew(i) : show(i);
                if (!kept) {
                    session.render(0, request.spp, interrupt.requested());
                }
            },
            [&] { renewed = true; });
        if (!kept) {
            exit_code = interrupt.requested() ? interrupt_exit_code() : exit_code;
            continue;
        }
        Picture picture = render_picture(session, frame, interrupt.requested(),
                                         {.label = frame_label(frame, request.frames), .quiet = options.json, .live = options.live}, options.files,
                                         guard, [&] { begin_anew(i); });
        if (picture.saved && options.json) {  // else nobody reads it, and a long sequence would fill the memory with it
            picture.json["pack_seconds"] = session.pack_seconds();
            picture.json["move_seconds"] = session.move_seconds();
            list.push_back(std::move(picture.json));
        }
        exit_code = exit_code == exit_done || picture_exit_code(picture) != exit_done ? picture_exit_code(picture) : exit_code;
    }
    if (options.json) {
        print_json(list);
    }
    return exit_code;
}

}  // namespace diptych::core::app
