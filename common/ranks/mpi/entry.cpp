#include "ranks/mpi/entry.h"

#include <string_view>

#include "ranks/mpi/mpi_channel.h"

extern "C" [[gnu::visibility("default")]] diptych::core::RankChannel* diptych_rank_library(const char* version);

diptych::core::RankChannel* diptych_rank_library(const char* version) {
    return std::string_view(version) == DIPTYCH_VERSION ? new diptych::core::MpiChannel() : nullptr;
}
