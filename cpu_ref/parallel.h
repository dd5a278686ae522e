// Loops on oneTBB whose order ThreadSanitizer can see: of a library that was built without it, it sees none, and takes
// every task for a race with what its caller did before.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define DIPTYCH_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__) || defined(DIPTYCH_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
// A task reads its own captures before it can tell of its order, and oneTBB may have copied them on another thread.
// Looks away from the task's own reads alone: what the task calls is not inlined into it, and is looked at.
#define DIPTYCH_TASK __attribute__((no_sanitize_thread))
#else
#define DIPTYCH_TASK
inline void __tsan_acquire(void*) {}
inline void __tsan_release(void*) {}
#endif

namespace diptych::core {

/// Stands where work is handed to other threads and awaited: all before it comes before every task, and all tasks
/// before what comes after.
class ForkJoin {
public:
    ForkJoin() { __tsan_release(&begin_); }
    ~ForkJoin() { __tsan_acquire(&end_); }
    ForkJoin(const ForkJoin&) = delete;
    ForkJoin& operator=(const ForkJoin&) = delete;

    class Task {
    public:
        explicit Task(ForkJoin& whole) : whole_(whole) { __tsan_acquire(&whole_.begin_); }
        ~Task() { __tsan_release(&whole_.end_); }
        Task(const Task&) = delete;
        Task& operator=(const Task&) = delete;

    private:
        ForkJoin& whole_;
    };

private:
    char begin_ = 0;
    char end_ = 0;
};

/// body(part) for parts of the range, as tbb::parallel_for has it.
template <class Range, class Body, class... Partitioner>
void parallel_over(const Range& range, const Body& body, const Partitioner&... partitioner) {
    ForkJoin whole;
    tbb::parallel_for(
        range,
        [&](const Range& part) DIPTYCH_TASK {
            const ForkJoin::Task task(whole);
            body(part);
        },
        partitioner...);
}

/// What work() gives, run among the arena's threads.
template <class Work>
auto run_in(tbb::task_arena& arena, const Work& work) {
    ForkJoin whole;
    return arena.execute([&]() DIPTYCH_TASK {
        const ForkJoin::Task task(whole);
        return work();
    });
}

}  // namespace diptych::core
