// What device memory is used for, and how much of it is in use.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace diptych::core {

/// Every allocation states one.
enum class Purpose {
    film,
    reservoirs,  // and what else the passes of resampling keep for every pixel
    paths_in_flight,
    structures,         // acceleration structures
    structure_scratch,  // and other inputs of their builds
    textures,
    vertices,
    tables,  // the scene's other arrays
    staging,
    readback,
    recorded_paths,
    pipelines,
    display,
    other,
};
inline constexpr std::size_t purpose_count = static_cast<std::size_t>(Purpose::other) + 1;

/// "the film", "paths in flight", as a message says it.
const char* name_of(Purpose purpose);

using BytesByPurpose = std::array<std::uint64_t, purpose_count>;

std::uint64_t total(const BytesByPurpose& bytes);

/// "the film 1.50 GB, textures 300 MB", the largest first; "nothing" if all are 0.
std::string text_of(const BytesByPurpose& bytes);

/// "1.50 GB", in powers of 1024.
std::string size_text(std::uint64_t bytes);

/// The bytes that a device has allocated, counted from any thread.
class MemoryUse {
public:
    void add(Purpose purpose, std::uint64_t bytes) { count(purpose) += bytes; }
    void remove(Purpose purpose, std::uint64_t bytes) { count(purpose) -= bytes; }
    BytesByPurpose bytes() const;

private:
    std::atomic<std::uint64_t>& count(Purpose purpose) { return counts_[static_cast<std::size_t>(purpose)]; }

    std::array<std::atomic<std::uint64_t>, purpose_count> counts_ = {};
};

/// Counts bytes as used for as long as it lives.
class MemoryCharge {
public:
    MemoryCharge() = default;
    MemoryCharge(std::shared_ptr<MemoryUse> use, Purpose purpose, std::uint64_t bytes);
    MemoryCharge(MemoryCharge&& other) noexcept { swap(other); }
    MemoryCharge& operator=(MemoryCharge&& other) noexcept {
        MemoryCharge(std::move(other)).swap(*this);
        return *this;
    }
    ~MemoryCharge();

private:
    void swap(MemoryCharge& other) noexcept;

    std::shared_ptr<MemoryUse> use_;
    Purpose purpose_ = Purpose::other;
    std::uint64_t bytes_ = 0;
};

}  // namespace diptych::core
