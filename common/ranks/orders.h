// What ranks tell each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ranks/word_stream.h"

namespace diptych::core {

/// Exit code where no rank can go on.
inline constexpr int exit_no_rank = 3;

/// The kinds of Message.
enum class Tell : std::uint32_t {
    // To rank 0.
    hello,        // Hello: this rank is there
    ready,        // Ready: it can render
    ask,          // it has finished its block, and wants an order
    merged,       // attempt: rank 0 alone, the films of all ranks are added up
    lost,         // reason: its samples are gone, but it goes on with its block
    gave_up,      // reason: it can render no more
    interrupted,  // exit code: a signal asks all to stop
    saved,        // samples: it has written its part, or had nothing to write
    note,         // text for rank 0's user
    // To the other ranks.
    order,  // Order
    // Either way.
    alive,
    // Between ranks that add up films.
    film,
};

struct Hello {
    std::string host;
    std::string process_space;  // processes of one space see each other's ids
    std::uint64_t process = 0;

    std::vector<std::uint32_t> words() const { return WordWriter().put(host).put(process_space).put(process).take(); }
    static Hello of(const std::vector<std::uint32_t>& words) {
        WordReader reader(words);
        Hello hello;
        hello.host = reader.text();
        hello.process_space = reader.text();
        hello.process = reader.number();
        return hello;
    }
};

struct Ready {
    std::string picture;  // identity of what it renders
    std::string device;

    std::vector<std::uint32_t> words() const { return WordWriter().put(picture).put(device).take(); }
    static Ready of(const std::vector<std::uint32_t>& words) {
        WordReader reader(words);
        Ready ready;
        ready.picture = reader.text();
        ready.device = reader.text();
        return ready;
    }
};

struct Order {
    enum class Kind : std::uint64_t {
        render,    // `block`
        merge,     // `attempt`, of `ranks`
        abandon,   // the merge `attempt`, because one of its ranks is gone
        finished,  // rank 0 alone: the picture is whole, or all ranks have saved their parts
        stop,      // save the part; `code` is the exit code
        cut_off,   // rank 0 is out of reach: save the part, and leave
        end,       // leave with the exit code `code`; `alone` where ranks have died
    };

    Kind kind = Kind::end;
    SampleRange block = {};
    std::uint64_t attempt = 0;
    std::vector<int> ranks = {};
    int code = 0;
    bool alone = false;

    std::vector<std::uint32_t> words() const {
        WordWriter writer;
        writer.put(static_cast<std::uint64_t>(kind)).put(block).put(attempt);
        writer.put(static_cast<std::uint64_t>(code)).put(std::uint64_t{alone}).put(std::uint64_t{ranks.size()});
        for (const int rank : ranks) {
            writer.put(static_cast<std::uint64_t>(rank));
        }
        return writer.take();
    }
    static Order of(const std::vector<std::uint32_t>& words) {
        WordReader reader(words);
        Order order;
        order.kind = static_cast<Kind>(reader.number());
        order.block = reader.range();
        order.attempt = reader.number();
        order.code = reader.integer();
        order.alone = reader.number() != 0;
        order.ranks.resize(reader.number());
        for (int& rank : order.ranks) {
            rank = reader.integer();
        }
        return order;
    }
};

}  // namespace diptych::core
