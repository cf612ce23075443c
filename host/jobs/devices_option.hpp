// --devices: which devices a run is spread over, and which of them a rank takes.
// All devices of a run are of one kind, CPU or GPU, since that is part of what a run is.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "gpu/gpu.hpp"
#include "jobs/ranks.hpp"

namespace wavetracer {

// devices: "all" (those like the default one), "gpu", "cpu" or indices, "0,1,2"; empty: those of the platform and kind
// of the one that `device` (--device) chooses. Indices, at least one. Throws ConfigError or DeviceError.
std::vector<size_t> choose_devices(const std::vector<gpu::DeviceInfo>& there, const std::string& devices,
                                   const std::string& device);

// The same for a process that starts others, one device where `devices` is empty. Indices are taken as they are given:
// the children check them. To be called before anything of OpenCL is.
std::vector<size_t> devices_to_start_on(const std::string& devices, const std::string& device);

// The cores that this process may use are divided evenly among the ranks of this host, before anything starts threads:
// host threads and CPU devices keep to their share. What a launcher has bound stays as it is.
void take_share_of_cores(const Ranks& ranks);

}  // namespace wavetracer
