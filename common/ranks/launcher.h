// The launchers that start several processes for one render.
#pragma once

#include <memory>
#include <string>

#include "ranks/channel.h"

namespace diptych::core {

/// The launcher that started this process as one of several, by its environment; empty where there is none.
std::string launcher();

/// Loads libdiptych_mpi.so and joins the others. Throws an Error that names the launcher where MPI is missing or
/// another than Open MPI, which Diptych is built with.
std::unique_ptr<RankChannel> join_ranks();

}  // namespace diptych::core
