#include "ranks/mpi/entry.h"

#include "ranks/mpi/mpi_channel.h"

extern "C" {
[[gnu::visibility("default")]] extern const char diptych_rank_interface[];
const char diptych_rank_interface[] = DIPTYCH_RANKS_INTERFACE;

[[gnu::visibility("default")]] diptych::core::RankChannel* diptych_rank_library();
diptych::core::RankChannel* diptych_rank_library() {
    return new diptych::core::MpiChannel();
}
}
