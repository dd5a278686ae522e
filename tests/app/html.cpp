#include "html.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace diptych::core::tests {

namespace {

const std::set<std::string> without_end = {"!doctype", "meta", "img", "br", "hr", "link", "input"};

std::string name_at(const std::string& page, std::size_t at) {
    std::string name;
    while (at < page.size() && (std::isalnum(static_cast<unsigned char>(page[at])) != 0 || page[at] == '!')) {
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(page[at++])));
    }
    return name;
}

/// The '>' that ends the tag, past quoted attributes.
std::size_t end_of_tag(const std::string& page, std::size_t at) {
    bool quoted = false;
    for (; at < page.size(); ++at) {
        quoted = page[at] == '"' ? !quoted : quoted;
        if (page[at] == '>' && !quoted) {
            return at;
        }
    }
    return std::string::npos;
}

}  // namespace

std::string html_fault(const std::string& page) {
    std::vector<std::string> open;
    const auto fault = [&](const std::string& what, std::size_t at) {
        return what + " after " + page.substr(at > 60 ? at - 60 : 0, std::min<std::size_t>(at, 60));
    };
    for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at)) {
        const bool closes = page.compare(at, 2, "</") == 0;
        const std::string name = name_at(page, at + (closes ? 2 : 1));
        const std::size_t end = end_of_tag(page, at);
        if (name.empty() || end == std::string::npos) {
            return fault("a tag without name or end", at);
        }
        if (closes) {
            if (open.empty() || open.back() != name) {
                return fault("</" + name + "> closes nothing", at);
            }
            open.pop_back();
        } else if (without_end.count(name) == 0 && page[end - 1] != '/') {  // "/>" ends an element of SVG
            open.push_back(name);
        }
        at = end + 1;
        if (!closes && (name == "script" || name == "style")) {
            at = page.find("</" + name, at);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> stays open";
}

std::string html_script(const std::string& page, const std::string& id) {
    const std::size_t tag = page.find("id=\"" + id + "\">");
    const std::size_t begin = tag == std::string::npos ? tag : page.find('>', tag) + 1;
    return begin == std::string::npos ? "" : page.substr(begin, page.find("</script>", begin) - begin);
}

}  // namespace diptych::core::tests
