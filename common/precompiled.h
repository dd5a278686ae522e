// What most sources read and none changes, read once a build: CMake puts it before each. Every source still includes
// what it uses, since a build may go without (CMAKE_DISABLE_PRECOMPILE_HEADERS).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
