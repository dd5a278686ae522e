#include "skipping.h"

#include <cstdio>

#include "catch.h"

namespace {

bool any = false;

}  // namespace

void diptych::tests::report_skipped(const std::string& reason) {
    any = true;
    std::printf("SKIPPED: %s\n", reason.c_str());
    std::fflush(stdout);
}

bool diptych::tests::any_skipped() {
    return any;
}
