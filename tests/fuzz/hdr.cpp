#include "picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const diptych::core::fuzz::InputFile file("picture.hdr");
    return diptych::core::fuzz::read_picture(file, {data, size});
}
