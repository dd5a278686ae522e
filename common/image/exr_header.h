// The attributes of an EXR file, looked over before OpenEXR reads them: it allocates what an attribute says that it holds,
// which a file of a few hundred bytes can put at 2 GB.
#pragma once

#include <filesystem>
#include <string>

namespace diptych::core {

/// Why the headers are not handed to OpenEXR: an attribute claims more bytes than the file has, or not as many as its
/// value. Empty where there is no such reason, and for a file that is no EXR.
std::string exr_header_problem(const std::filesystem::path& path);

}  // namespace diptych::core
