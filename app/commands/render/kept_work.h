// The samples of a picture that earlier runs have left in files, and the files that this run leaves.
#pragma once

#include <future>
#include <optional>
#include <string>

#include "render/film_file.h"
#include "render/metadata.h"
#include "render/request.h"
#include "render/session.h"

namespace diptych::core::app {

/// What a user asks of the files beside a picture's own.
struct WorkFiles {
    std::string checkpoint;   // written as the picture grows; empty is none
    double every = 60;        // seconds between two of them
    std::string resume;       // samples to go on from; empty is what lies beside the output
    bool overwrite = false;   // begin anew, and replace whatever is there
    std::string fallback_folder;  // for what cannot be written to its place (save_picture.h)
};

/// "out.part.exr" for "out.png": where unfinished work goes.
std::string part_path(const std::string& output);

/// Where a rank of several leaves its share of the samples that belong into `path`: "out.rank2.part.exr" for "out.exr"
/// and "out.part.exr".
std::string rank_part_path(const std::string& path, int rank);

/// The files of ranks, of earlier runs or of this one, that belong to `path`.
std::vector<std::string> rank_parts(const std::string& path);

/// Bytes that a file with samples of this picture may ask for: `memory_limit`, and by default as much as the picture's
/// own film has at least, which the user asked for and not the file.
std::uint64_t kept_film_limit(const RenderRequest& request);

/// Samples per pixel that a picture's metadata tell; 0 where the file is missing or does not tell.
std::uint64_t samples_in(const std::string& path);

/// Throws Error where the output is a picture of more samples than are asked for, or one of its inputs.
void refuse_to_lose(const RenderRequest& request, const WorkFiles& files);

/// Samples to go on from.
struct KeptWork {
    std::vector<std::string> paths;  // where they were; empty where there are none
    Film film;                       // every pixel with the same samples
    SampleRanges samples;
    std::uint32_t spp = 0;  // their number
    double seconds = 0;
    std::uint64_t look_at = 0;  // ProgressiveTarget's; 0 where it is not known
};

/// Samples of this picture that `files`, the part beside the output, or parts of ranks beside these hold: files without
/// samples in common, those with the most samples first. Where a run was cut short within a sample, the session takes
/// that sample of the pixels that lack it. `metadata` are those that the picture will have. Throws Error where a file
/// holds another picture, or more than is asked for.
KeptWork find_kept_work(Session& session, const RenderRequest& request, const WorkFiles& files,
                        const std::map<std::string, std::string>& metadata);

/// Writes films in the background.
class Checkpoints {
public:
    explicit Checkpoints(double every);
    ~Checkpoints();

    /// Whether it is time, and the one before has been written.
    bool due() const;

    /// Calls `write` in a thread of its own.
    void begin(std::function<void()> write);

    /// Waits for the one that is being written.
    void finish();

private:
    double every_;
    double next_;
    std::future<void> writing_;
};

}  // namespace diptych::core::app
