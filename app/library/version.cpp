#include "library/version.h"

#include "build_info.h"

DIPTYCH_BEGIN

std::string program_version() {
    return core::build_info::program();
}

DIPTYCH_END
