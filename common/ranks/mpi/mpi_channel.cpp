#include "ranks/mpi/mpi_channel.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace diptych::core {

namespace {

void check(int result) {
    if (result != MPI_SUCCESS) {
        char text[MPI_MAX_ERROR_STRING] = {};
        int length = 0;
        MPI_Error_string(result, text, &length);
        throw std::runtime_error("MPI: " + std::string(text, static_cast<std::size_t>(length)));
    }
}

cpu_set_t own_processors() {
    cpu_set_t own;
    CPU_ZERO(&own);
    sched_getaffinity(0, sizeof(own), &own);
    return own;
}

/// How many ranks of a host may run on one of these processors.
int count_sharing(MPI_Comm host, int local_size, const cpu_set_t& own) {
    std::vector<cpu_set_t> all(static_cast<std::size_t>(local_size));
    check(MPI_Allgather(&own, sizeof(own), MPI_BYTE, all.data(), sizeof(own), MPI_BYTE, host));
    return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const cpu_set_t& other) {
        cpu_set_t both;
        CPU_AND(&both, &own, &other);
        return CPU_COUNT(&both) > 0;
    }));
}

}  // namespace

MpiChannel::MpiChannel() {
    int level = 0;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level));
    if (level < MPI_THREAD_SERIALIZED) {
        throw std::runtime_error("MPI: was built without threads");
    }
    // The death of a rank must not end the others.
    check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN));
    check(MPI_Comm_rank(MPI_COMM_WORLD, &place_.rank));
    check(MPI_Comm_size(MPI_COMM_WORLD, &place_.size));
    MPI_Comm host;
    check(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, place_.rank, MPI_INFO_NULL, &host));
    int local_size = 0;
    check(MPI_Comm_rank(host, &place_.local_rank));
    check(MPI_Comm_size(host, &local_size));
    const cpu_set_t own = own_processors();
    place_.processors = std::max(1, CPU_COUNT(&own));
    place_.sharing = count_sharing(host, local_size, own);
    check(MPI_Comm_free(&host));
    char name[256] = {};
    gethostname(name, sizeof(name) - 1);
    place_.host = name;
    receiving_.resize(static_cast<std::size_t>(place_.size));
}

void MpiChannel::send(int to, std::uint32_t kind, std::vector<std::uint32_t> words) {
    if (words.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw std::runtime_error("MPI: a message is too long");
    }
    sending_.push_back({to, std::move(words), MPI_REQUEST_NULL});
    Sending& last = sending_.back();
    check(MPI_Isend(last.words.data(), static_cast<int>(last.words.size()), MPI_UINT32_T, to, static_cast<int>(kind),
                    MPI_COMM_WORLD, &last.request));
}

void MpiChannel::begin_receives() {
    for (;;) {
        int waits = 0;
        MPI_Message handle;
        MPI_Status status;
        check(MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &waits, &handle, &status));
        if (waits == 0) {
            return;
        }
        int count = 0;
        check(MPI_Get_count(&status, MPI_UINT32_T, &count));
        auto& line = receiving_[static_cast<std::size_t>(status.MPI_SOURCE)];
        line.push_back({{status.MPI_SOURCE, static_cast<std::uint32_t>(status.MPI_TAG), {}}, MPI_REQUEST_NULL});
        Receiving& last = line.back();
        last.message.words.resize(static_cast<std::size_t>(count));
        check(MPI_Imrecv(last.message.words.data(), count, MPI_UINT32_T, &handle, &last.request));
    }
}

void MpiChannel::drop_sent() {
    for (auto i = sending_.begin(); i != sending_.end();) {
        int sent = 0;
        check(MPI_Test(&i->request, &sent, MPI_STATUS_IGNORE));
        i = sent != 0 ? sending_.erase(i) : i + 1;
    }
}

std::optional<Message> MpiChannel::receive() {
    drop_sent();
    begin_receives();
    for (std::size_t i = 0; i < receiving_.size(); ++i) {
        next_sender_ = (next_sender_ + 1) % receiving_.size();
        auto& line = receiving_[next_sender_];
        int here = 0;
        if (!line.empty()) {
            check(MPI_Test(&line.front().request, &here, MPI_STATUS_IGNORE));
        }
        if (here != 0) {
            Message message = std::move(line.front().message);
            line.pop_front();
            return message;
        }
    }
    return std::nullopt;
}

std::size_t MpiChannel::pending_words(int to) const {
    std::size_t words = 0;
    for (const Sending& sending : sending_) {
        words += sending.to == to ? sending.words.size() : 0;
    }
    return words;
}

void MpiChannel::leave() {
    check(MPI_Finalize());
}

}  // namespace diptych::core
