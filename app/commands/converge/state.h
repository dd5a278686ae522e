// What `converge` keeps in its folder between one run and the next, so that it can stop at any moment and go on.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stats/bias_squared.h"

namespace diptych::app {

/// One render's errors against the reference once it had so many samples a pixel: a line of results.csv.
struct ErrorRow {
    std::string method;
    std::uint32_t run = 0;
    std::uint32_t seed = 0;
    std::uint32_t spp = 0;
    double device_seconds = 0;  // since the run's first sample: timestamps on a GPU, wall clock on the CPU
    double wall_seconds = 0;    // by a steady clock, around the same calls
    double mse = 0;
    double relmse = 0;
    double relmse_trimmed = 0;
    double trimmed_energy = 0;
    std::uint64_t nonfinite = 0;  // samples dropped so far
    std::uint64_t rays = 0;
};

/// results.jsonl holds a line for each event: "setup" (what building a method took), "limit" (how many samples fit the
/// time), "reference", "run" (the ErrorRows of one run), "picture". Lines are only ever appended.
class ConvergeState {
public:
    /// Reads what is there; a last line that was cut off is dropped. Throws Error.
    explicit ConvergeState(const std::string& folder);

    void append(const nlohmann::ordered_json& event);
    void append(const std::vector<ErrorRow>& run);

    const std::vector<ErrorRow>& rows() const { return rows_; }
    /// Whole runs of a method.
    std::uint32_t runs(const std::string& method) const;
    /// The latest event of that kind, of that method where one is named; null where there is none.
    nlohmann::ordered_json latest(const std::string& kind, const std::string& method = "") const;

    /// All rows, with a line of column names. Throws Error.
    void write_csv() const;

    /// The sums over a method's runs, by sample count; empty where none are kept yet. Throws Error where the file is
    /// not whole.
    std::map<std::uint32_t, DeviationSums> load_sums(const std::string& method) const;
    void save_sums(const std::string& method, const std::map<std::uint32_t, DeviationSums>& sums) const;

    const std::string& folder() const { return folder_; }
    std::string path(const std::string& name) const;

private:
    void append_text(const std::string& lines) const;
    std::string sums_path(const std::string& method) const;

    std::string folder_;
    std::vector<ErrorRow> rows_;
    std::vector<nlohmann::ordered_json> events_;
};

}  // namespace diptych::app
