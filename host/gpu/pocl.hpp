// PoCL, the OpenCL of CPUs: it keeps a cache of compiled kernels of its own, and offers no device where it cannot.
#pragma once
#include <filesystem>
#include <string>
#include "gpu/gpu.hpp"

namespace wavetracer::gpu {

// Where PoCL keeps its cache, by the environment as it is now.
std::filesystem::path pocl_cache_folder();

// To be called before the first use of OpenCL, which reads the environment once: where the user has not chosen a folder
// and PoCL's own choice cannot be written to, POCL_CACHE_DIR is set to a folder of this user below a temporary one.
void give_pocl_a_cache();

// Tells the user what give_pocl_a_cache() has done; empty where it has done nothing.
std::string pocl_cache_note();

// Tells the user what to do about a cache that cannot be written to; empty where it can, and where there is no PoCL.
std::string pocl_cache_problem();

}  // namespace wavetracer::gpu
