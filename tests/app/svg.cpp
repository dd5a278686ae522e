#include "svg.h"

#include "skipping.h"

namespace diptych::core::tests {

void check_svg_files(const TemporaryFolder& folder, const std::vector<std::string>& files) {
    std::vector<std::string> arguments = {"python3", DIPTYCH_SOURCE_DIR "/tests/scripts/check_svg.py"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const ProcessResult result = run_diptych(folder, arguments, {}, "/usr/bin/env");
    if (result.exit_code == 127) {
        report_left_out("what an XML parser says of SVG files: python3 is not installed");
        return;
    }
    CHECK(result.out == "\n");
    CHECK(result.err == "");
    CHECK(result.exit_code == 0);
}

}  // namespace diptych::core::tests
