// What the library calls itself.
#pragma once

#include <string>

#include "diptych/export.h"

DIPTYCH_BEGIN

/// "diptych 0.1.0 (commit …)", as the program's pictures say it. A source of its own, which every commit compiles anew.
std::string program_version();

/// Twelve hexadecimal digits, or "unknown".
std::string program_commit();

DIPTYCH_END
