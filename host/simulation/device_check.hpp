// SPDX-License-Identifier: Apache-2.0
// The check of a device: its results for a small world are compared with known ones.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"

namespace wavetracer {

// Runs the kernels that these features need, on inputs that are always the same. Sorts, sums and traversal are compared
// with the host's own; a frame with known sequences and points, and its fields with the host's; a cache is checked if
// there is one. An exception of the device fails the check that it came from, and ends the checks. The context has the
// device's kernels afterwards, so a run compiles nothing twice.
std::vector<CheckResult> check_device(gpu::Context& context, const CheckedFeatures& features);

}  // namespace wavetracer
