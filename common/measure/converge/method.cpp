#include "measure/converge/method.h"

#include <algorithm>

namespace diptych::core {

std::string file_stem(const std::string& method) {
    std::string stem = method;
    std::replace(stem.begin(), stem.end(), ':', '-');
    std::replace(stem.begin(), stem.end(), '/', '-');
    return stem;
}

}  // namespace diptych::core
