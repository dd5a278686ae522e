// The way into libdiptych_mpi.so.
#pragma once

#include "ranks/channel.h"

namespace diptych::core {

/// Text by which a program knows that the library was built with the same interface as itself. Otherwise no function
/// may be called.
inline constexpr const char* rank_library_interface = "diptych_rank_interface";

/// Starts MPI and gives the channel over it to the caller.
using RankLibraryEntry = RankChannel*();
inline constexpr const char* rank_library_entry = "diptych_rank_library";

}  // namespace diptych::core
