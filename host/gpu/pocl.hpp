// SPDX-License-Identifier: Apache-2.0
// PoCL, the OpenCL of CPUs: it keeps its own cache of compiled kernels, and offers no device if it cannot.
#pragma once
#include <filesystem>
#include <string>
#include "gpu/gpu.hpp"

namespace wavetracer::gpu {

// Returns the folder of PoCL's cache, by the current environment.
std::filesystem::path pocl_cache_folder();

// Must be called before the first use of OpenCL, which reads the environment once. If the user has not chosen a folder
// and PoCL's own choice cannot be written to, it sets POCL_CACHE_DIR to a folder of this user below a temporary one.
void give_pocl_a_cache();

// Returns a note on what give_pocl_a_cache() has done; empty if it has done nothing.
std::string pocl_cache_note();

// Returns what to do about a cache that cannot be written to; empty if it can, or if there is no PoCL.
std::string pocl_cache_problem();

}  // namespace wavetracer::gpu
