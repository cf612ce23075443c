// SPDX-License-Identifier: Apache-2.0
// --devices: the devices that a run is spread over, and the choice of one for each rank.
// All devices of a run are of one kind, CPU or GPU, since the kind is part of a run's identity.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "gpu/gpu.hpp"
#include "jobs/ranks.hpp"

namespace wavetracer {

// devices: "all" (those like the default one), "gpu", "cpu" or indices, "0,1,2"; empty: those of the platform and kind
// of the one that `device` (--device) chooses. Returns indices, at least one. Throws ConfigError or DeviceError.
std::vector<size_t> choose_devices(const std::vector<gpu::DeviceInfo>& there, const std::string& devices,
                                   const std::string& device);

// Does the same for a process that starts others; it returns one device if `devices` is empty. Indices are not checked
// here: the children check them. It must be called before any use of OpenCL.
std::vector<size_t> devices_to_start_on(const std::string& devices, const std::string& device);

// Divides the cores that this process may use evenly among the ranks of this host, before threads are started: host
// threads and CPU devices keep to their share. A binding made by a launcher is left unchanged.
void take_share_of_cores(const Ranks& ranks);

}  // namespace wavetracer
