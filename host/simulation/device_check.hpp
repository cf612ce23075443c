// SPDX-License-Identifier: Apache-2.0
// The check of a device: its results for a small world are compared with known ones.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"

namespace wavetracer {

// Runs the kernels that these features need, on inputs that are always the same. Sorts, sums and traversal are compared
// with the host's own; a frame with known sequences and points, and its fields with the host's; a cache, a next frame
// that reuses sequences and sums of links are checked if the features have them. An exception of the device fails the
// check that it came from, and ends the checks. The context has the device's kernels afterwards, so a run compiles
// nothing twice. kernels: if given, the names of the kernels that ran are added to it, "program/kernel".
std::vector<CheckResult> check_device(gpu::Context& context, const CheckedFeatures& features,
                                      std::set<std::string>* kernels = nullptr);

}  // namespace wavetracer
