// The options of the command line that set what the library names in its messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace diptych::core::app {

struct OptionName {
    std::string_view setting;  // the library's name
    std::string_view option;
};

/// Every setting that a message of the library names.
std::span<const OptionName> option_names();

/// A message of the library (error.h) in the command line's words: "`look_at`" becomes "--look-at".
std::string with_option_names(const std::string& message);

}  // namespace diptych::core::app
