// SVG files, held to what every viewer asks of them.
#pragma once

#include "process.h"

namespace diptych::core::tests {

/// Checks the files with tests/scripts/check_svg.py; says LEFT OUT where there is no Python.
void check_svg_files(const TemporaryFolder& folder, const std::vector<std::string>& files);

}  // namespace diptych::core::tests
