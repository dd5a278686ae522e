// A sink as OpenImageIO's libraries write to it.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <exception>
#include <vector>

#include "image/byte_sink.h"

namespace diptych::core {

/// OpenEXR writes a few bytes at a time. They are gathered, because each write to a disk has its cost.
class SinkProxy final : public OIIO::Filesystem::IOProxy {
public:
    explicit SinkProxy(ByteSink& sink) : IOProxy("", Write), sink_(&sink) { gathered_.reserve(most_gathered); }

    const char* proxytype() const override { return "sink"; }
    bool seek(int64_t place) override {
        m_pos = place;
        return true;
    }
    size_t write(const void* bytes, size_t count) override {
        const size_t written = pwrite(bytes, count, m_pos);
        m_pos += static_cast<int64_t>(written);
        return written;
    }
    size_t pwrite(const void* bytes, size_t count, int64_t place) override {
        if (place != begin_ + static_cast<int64_t>(gathered_.size()) || gathered_.size() + count > most_gathered) {
            flush();
            begin_ = place;
        }
        const auto* const first = static_cast<const unsigned char*>(bytes);
        if (count > most_gathered) {
            put(place, {first, count});
            begin_ = place + static_cast<int64_t>(count);
        } else {
            gathered_.insert(gathered_.end(), first, first + count);
        }
        end_ = std::max(end_, static_cast<size_t>(place) + count);
        return failure_ ? 0 : count;
    }
    size_t size() const override { return end_; }
    void flush() const override {
        put(begin_, gathered_);
        begin_ += static_cast<int64_t>(gathered_.size());
        gathered_.clear();
    }

    /// What the sink threw, which OpenImageIO only knows as a failed write.
    void rethrow() const {
        if (failure_) {
            std::rethrow_exception(failure_);
        }
    }

private:
    static constexpr size_t most_gathered = size_t{4} << 20U;

    void put(int64_t place, std::span<const unsigned char> bytes) const {
        try {
            if (!failure_) {
                sink_->write_at(static_cast<std::uint64_t>(place), bytes);
            }
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    ByteSink* sink_;
    // OpenImageIO's `flush` is const.
    mutable std::vector<unsigned char> gathered_;
    mutable int64_t begin_ = 0;  // of what is gathered, in the file
    mutable std::exception_ptr failure_;
    size_t end_ = 0;
};

}  // namespace diptych::core
