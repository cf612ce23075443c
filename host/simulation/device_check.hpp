// A device is checked: what it computes of a small world against what is known of it.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"

namespace wavetracer {

// Runs the kernels that these features need, on inputs that are always the same: sorts, sums and traversal against the
// host's own; a frame, against known sequences and points, and its fields against the host's; a cache, where there is
// one. An exception of the device fails the check that it came from, and ends them. The context has the device's
// kernels afterwards, so a run compiles nothing twice.
std::vector<CheckResult> check_device(gpu::Context& context, const CheckedFeatures& features);

}  // namespace wavetracer
