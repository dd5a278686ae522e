// The methods of a measurement of convergence, by their names: BACKEND:INTEGRATOR, BACKEND:INTEGRATOR:SAMPLER, oracle
// or oracle:MODE.
#pragma once

#include <string>
#include <vector>

#include "measure/converge/method.h"

namespace diptych::core {

/// "vulkan" of "vulkan:path".
std::string backend_in(const std::string& method);

/// Whether the text begins as a method, and is no file.
bool names_method(const std::string& text);

/// The method of that name, which has all other settings of `base`. `setting` is where the name came from. Throws Error
/// for a method that does not exist; whether the oracle has the mode shows when it is opened.
Method method_named(const char* setting, const std::string& name, const RenderRequest& base, const SeedPlan& seeds,
                    std::uint32_t place);

/// All of them, with seeds that derive from `seed`. Throws Error also for a method that is named twice.
std::vector<Method> plan_methods(const std::vector<std::string>& names, const RenderRequest& base, std::uint32_t seed,
                                 std::uint32_t runs);

/// The reference that is named so. "auto" is `path` on a backend for which it is not among the methods, else `path` with
/// the other MIS weights. Always over scrambled Sobol' sets, with seeds of its own.
Method plan_reference(const std::string& name, const RenderRequest& base, std::uint32_t seed,
                      const std::vector<Method>& methods);

}  // namespace diptych::core
