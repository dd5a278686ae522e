// Bytes that come a few at a time, for a sink that takes many at once.
#pragma once

#include <algorithm>
#include <cstring>

#include "image/byte_sink.h"

namespace diptych::core {

class GatheringSink {
public:
    explicit GatheringSink(ByteSink& sink) : sink_(&sink) {}

    void append(const void* bytes, std::size_t count) {
        const auto* from = static_cast<const unsigned char*>(bytes);
        while (count > 0) {
            if (gathered_ == most_gathered) {
                flush();
            }
            const std::size_t taken = std::min(count, most_gathered - gathered_);
            std::memcpy(pages_.get() + gathered_, from, taken);
            gathered_ += taken;
            from += taken;
            count -= taken;
        }
    }
    /// To be called at the end too.
    void flush() {
        sink_->write_at(begin_, {pages_.get(), gathered_});
        begin_ += gathered_;
        gathered_ = 0;
    }
    /// Of all that was appended.
    std::uint64_t size() const { return begin_ + gathered_; }

private:
    static constexpr std::size_t most_gathered = std::size_t{4} << 20U;

    ByteSink* sink_;
    Pages pages_ = make_pages(most_gathered);
    std::size_t gathered_ = 0;
    std::uint64_t begin_ = 0;  // of what is gathered, in the sink
};

}  // namespace diptych::core
