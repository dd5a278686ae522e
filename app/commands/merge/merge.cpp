#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <regex>

#include "commands/arguments/arguments.h"
#include "commands/command.h"
#include "commands/render/kept_work.h"
#include "console/output.h"
#include "console/repeat_command.h"
#include "error.h"
#include "image/image_file.h"
#include "image/tonemap_image.h"
#include "render/film_parts.h"
#include "render/merge_films.h"
#include "render/save_film.h"

namespace diptych::core::app {

namespace {

constexpr const char* merge_examples = R"(Examples:
  diptych render scene.glb --samples 0:512 -o part0.exr       on one machine
  diptych render scene.glb --samples 512:1024 -o part1.exr    on another
  diptych merge part*.exr -o whole.exr
The result has the bits of one render of all samples, however they were divided and in whatever order the parts are
named. Parts of another scene, of other settings or of another version of the program are refused; so are samples that
two parts have, and samples that none has, unless --partial is given.)";

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output;
    bool partial = false;
    bool sums = false;
    bool overwrite = false;
    std::uint64_t memory_limit = 0;
};

double number_of(const FilmFile& file, const char* name) {
    const auto found = file.metadata.find(name);
    return found == file.metadata.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
}

/// Adds a part to the whole, of which `parts` have come.
void add_part(const FilmPart& part, const FilmFile& file, const std::vector<FilmPart>& parts, FilmFile& whole) {
    require_same_picture(part.name, file.metadata, parts.front().name, whole.metadata);
    for (const FilmPart& other : parts) {
        if (other.name == part.name) {
            throw Error(fmt::format("{}: is given twice", part.name));
        }
        require_other_samples(part, other);
    }
    merge_films(file.film, whole.film);
    whole.samples.add(file.samples);
    whole.metadata["seconds"] = fmt::format("{}", number_of(whole, "seconds") + number_of(file, "seconds"));
}

/// The command of one render of them all.
std::string whole_command(const std::string& command, const SampleRanges& samples, const std::string& output) {
    if (samples.ranges().size() != 1) {
        return "";
    }
    const SampleRange range = samples.ranges().front();
    const std::string all = range.first == 0 ? fmt::format("--spp {}", range.end) : "--samples " + range_text(range);
    const std::string changed = std::regex_replace(command, std::regex(R"(--(spp \d+|samples \d+:\d+))"), all);
    return std::regex_replace(changed, std::regex(R"( -o ('[^']*'|\S+))"), " -o " + shell_quoted(output));
}

void describe(const MergeOptions& options, FilmFile& whole) {
    const std::string command = whole_command(whole.metadata["command"], whole.samples, options.output);
    count_anew(whole.film, whole.samples, whole.metadata);
    whole.metadata["command"] = command;
}

int run_merge(const MergeOptions& options) {
    check_writable(options.output);
    for (const std::string& part : options.parts) {
        std::error_code none;
        if (std::filesystem::equivalent(part, options.output, none)) {
            throw Error(fmt::format("-o {}: is one of the parts", options.output));
        }
    }
    FilmFile whole = read_part(options.parts.front(), options.memory_limit);
    std::vector<FilmPart> parts = {{options.parts.front(), whole.samples}};
    for (std::size_t i = 1; i < options.parts.size(); ++i) {
        const FilmFile file = read_part(options.parts[i], options.memory_limit);
        const FilmPart part{options.parts[i], file.samples};
        add_part(part, file, parts, whole);
        parts.push_back(part);
    }
    const SampleRanges missing = missing_samples(whole.samples);
    if (!missing.empty() && !options.partial) {
        throw Error(fmt::format("-o {}: no part has samples {}; give --partial to merge what is there", options.output,
                                missing.text()));
    }
    if (const std::uint64_t there = samples_in(options.output); there > whole.samples.count() && !options.overwrite) {
        throw Error(fmt::format("{}: is a picture of {} samples per pixel, and would be replaced by one of {}; give "
                                "--overwrite, or another -o",
                                options.output, there, whole.samples.count()));
    }
    describe(options, whole);
    save_film_file(whole, options.output, options.sums || !missing.empty());
    print_note("{}: {}x{}, samples {} of {} part{}\n", options.output, whole.film.width, whole.film.height,
               whole.samples.text(), parts.size(), parts.size() == 1 ? "" : "s");
    return exit_done;
}

}  // namespace

void add_merge(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("merge", "Put renders of parts of the samples together");
    auto options = std::make_shared<MergeOptions>();
    command->add_option("parts", options->parts, "Files of 'render --samples' or 'render --sums'")->required();
    command->add_option("-o,--output", options->output, "Image to write: .exr, .png or .hdr")->required();
    command->add_flag("--partial", options->partial, "Merge the parts although samples are missing between them");
    command->add_flag("--sums", options->sums,
                      "Keep the sums of the samples in the .exr, so that it can be merged and resumed");
    command->add_flag("--overwrite", options->overwrite, "Replace a picture of more samples");
    add_memory_option(*command, options->memory_limit);
    command->footer(merge_examples);
    command->callback([options, &run] { run = [options] { return run_merge(*options); }; });
}

}  // namespace diptych::core::app
