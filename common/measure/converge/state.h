// What a measurement has found, kept in a folder so that it can stop at any moment and go on.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measure/converge/events.h"
#include "stats/bias_squared.h"

namespace diptych::core {

/// results.jsonl holds a line for each event: "scene" (how long it took to load), "setup" (what building a method took),
/// "limit" (how many samples fit the time), "reference", "run" (the ErrorRows of one run), "picture". Lines are only
/// ever appended, and the latest counts.
class ConvergeState {
public:
    /// Reads what is there; a last line that was cut off is dropped. Throws Error.
    explicit ConvergeState(const std::string& folder);

    /// Each writes a line. Throws Error.
    void set_load_seconds(double seconds);
    void set_limit(const std::string& method, std::uint32_t spp);
    void set_setup(const std::string& method, const MethodSetup& setup);
    void set_reference(const RenderedReference& reference);
    void set_picture(const std::string& method, const MethodPicture& picture);
    void append(const std::vector<ErrorRow>& run);

    /// Nothing where there is none yet.
    std::optional<double> load_seconds() const { return load_seconds_; }
    std::optional<std::uint32_t> limit(const std::string& method) const;
    std::optional<MethodSetup> setup(const std::string& method) const;
    std::optional<RenderedReference> reference() const { return reference_; }
    std::optional<MethodPicture> picture(const std::string& method) const;
    const std::vector<ErrorRow>& rows() const { return rows_; }
    /// Whole runs of a method.
    std::uint32_t runs(const std::string& method) const;

    /// All rows, with a line of column names. Throws Error.
    void write_csv() const;

    /// The sums over a method's runs, by sample count; empty where none are kept yet. Throws Error where the file is
    /// not whole.
    std::map<std::uint32_t, DeviationSums> load_sums(const std::string& method) const;
    void save_sums(const std::string& method, const std::map<std::uint32_t, DeviationSums>& sums) const;

    const std::string& folder() const { return folder_; }
    std::string path(const std::string& name) const;

private:
    void take(const nlohmann::ordered_json& event);
    void append_line(const std::string& text) const;
    std::string sums_path(const std::string& method) const;

    std::string folder_;
    std::optional<double> load_seconds_;
    std::map<std::string, std::uint32_t> limits_;  // by method, as those below
    std::map<std::string, MethodSetup> setups_;
    std::map<std::string, MethodPicture> pictures_;
    std::optional<RenderedReference> reference_;
    std::vector<ErrorRow> rows_;
};

}  // namespace diptych::core
