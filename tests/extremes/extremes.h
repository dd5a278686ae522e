// The cases of `diptych stability`, held to their bounds, a file a row of the table.
#pragma once

#include <string>

#include "catch.h"
#include "stability_cases.h"

namespace diptych::core::tests {

/// Every case of the row on both backends, at few points of its range; or at all of them.
void check_row(const std::string& row);
void check_row_in_full(const std::string& row);

}  // namespace diptych::core::tests
