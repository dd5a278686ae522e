// Where an encoder puts the bytes of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

namespace diptych::core {

/// A sink takes bytes fastest whose place, address and number are multiples of this: they go to the disk without a copy.
inline constexpr std::size_t sink_page = 4096;

struct FreePages {
    void operator()(unsigned char* pages) const { std::free(pages); }
};
using Pages = std::unique_ptr<unsigned char[], FreePages>;

/// Memory for so many bytes, at the address of a page.
inline Pages make_pages(std::size_t bytes) {
    const std::size_t whole = (bytes + sink_page - 1) / sink_page * sink_page;
    auto* const pages = static_cast<unsigned char*>(std::aligned_alloc(sink_page, whole));
    if (pages == nullptr) {
        throw std::bad_alloc();
    }
    return Pages(pages);
}

class ByteSink {
public:
    virtual ~ByteSink() = default;
    /// Formats with tables write those last, before what they have written already. Throws Error.
    virtual void write_at(std::uint64_t place, std::span<const unsigned char> bytes) = 0;
};

}  // namespace diptych::core
