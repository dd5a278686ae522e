#include "library/version.h"

#include "build_info.h"

DIPTYCH_BEGIN

std::string program_version() {
    return core::build_info::program();
}

std::string program_commit() {
    return core::build_info::commit;
}

DIPTYCH_END
