#include "ranks/launcher.h"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "error.h"
#include "own_library.h"
#include "ranks/mpi/entry.h"

namespace diptych::core {

namespace {

constexpr const char* file_name = "libdiptych_mpi.so";
constexpr const char* mpi_name = "libmpi.so.40";  // Open MPI's, of versions 4 and 5

int number_in(const char* variable) {
    const char* const text = std::getenv(variable);
    return text == nullptr ? 0 : std::atoi(text);
}

[[noreturn]] void fail(const std::string& reason) {
    throw Error(launcher() + " started this process as one of several, but " + file_name +
                ", which joins them, cannot be used: " + reason);
}

}  // namespace

std::string launcher() {
    if (number_in("OMPI_COMM_WORLD_SIZE") > 1) {
        return "mpirun";
    }
    // A job step of one process, or a script under sbatch, renders alone.
    if (std::getenv("PMIX_RANK") != nullptr && number_in("SLURM_STEP_NUM_TASKS") > 1) {
        return "srun";
    }
    return number_in("PMI_SIZE") > 1 ? "mpiexec" : "";
}

std::unique_ptr<RankChannel> join_ranks() {
    // MPI's plugins and our library look for its symbols among those of the process.
    if (dlopen(mpi_name, RTLD_NOW | RTLD_GLOBAL) == nullptr) {
        fail(std::string(dlerror()) + "; Debian has it in the package openmpi-bin");
    }
    void* const library = open_own_library(file_name, RTLD_NOW);
    if (library == nullptr) {
        fail(std::string(dlerror()) + "; Diptych is built with it where the package libopenmpi-dev is installed");
    }
    const auto* interface = static_cast<const char*>(dlsym(library, rank_library_interface));
    const auto entry = reinterpret_cast<RankLibraryEntry*>(dlsym(library, rank_library_entry));
    if (entry == nullptr || interface == nullptr || interface != std::string_view(DIPTYCH_RANKS_INTERFACE)) {
        fail("it belongs to another build than this program, which needs the interface " DIPTYCH_RANKS_INTERFACE);
    }
    std::unique_ptr<RankChannel> channel;
    try {
        channel.reset(entry());
    } catch (const std::runtime_error& error) {
        fail(error.what());
    }
    if (channel->place().size == 1) {
        fail("the launcher belongs to another MPI than Open MPI, or was built without PMIx");
    }
    return channel;
}

}  // namespace diptych::core
