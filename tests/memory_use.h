// The memory of this process, for tests that nothing leaks.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include <malloc.h>
#include <unistd.h>

namespace diptych::core::tests {

/// In bytes.
struct MemoryUse {
    double allocated = 0;  // what the program holds of malloc's
    double resident = 0;   // what the kernel has given it
};

/// Sanitizers have allocators of their own, which keep what is freed.
inline bool measures_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return false;
#else
    return true;
#endif
}

inline MemoryUse memory_use() {
    malloc_trim(0);  // else free memory counts as resident
    const struct mallinfo2 info = mallinfo2();
    double pages = 0;
    double resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return {static_cast<double>(info.uordblks + info.hblkhd), resident * static_cast<double>(sysconf(_SC_PAGESIZE))};
}

}  // namespace diptych::core::tests
