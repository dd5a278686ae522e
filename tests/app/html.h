// What can be asked of a page without a browser.
#pragma once

#include <string>

namespace diptych::core::tests {

/// The first tag that closes nothing, or stays open at the end, with the text before it; empty where all is well.
/// Elements without an end are known, what script and style hold is not looked at.
std::string html_fault(const std::string& page);

/// The text of the script element with this id; empty where there is none.
std::string html_script(const std::string& page, const std::string& id);

}  // namespace diptych::core::tests
