// The way into libdiptych_mpi.so.
#pragma once

#include "ranks/channel.h"

namespace diptych::core {

/// Starts MPI and gives the channel over it to the caller; null for a caller of another version.
using RankLibraryEntry = RankChannel*(const char* version);
inline constexpr const char* rank_library_entry = "diptych_rank_library";

}  // namespace diptych::core
