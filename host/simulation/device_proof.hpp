// SPDX-License-Identifier: Apache-2.0
// The proof of a device before it is used: it has passed the checks of device_check.hpp, now or in an earlier start.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"

namespace wavetracer {

struct Setup;

// The sets of features that are checked for a run of this setup, one after the other. The thesis' tables of a ray cache
// are left out: they keep the faults of the printed code, which are not a device's.
std::vector<CheckedFeatures> features_to_check(const Setup& setup);

// Checks the device for these features, unless it has passed before with the same driver, platform, kernels and version
// of the program. That result is stored beside the compiled kernels; without room for it, each call checks. Throws
// DeviceError that names device and driver, the failed check, and a remedy.
void prove_device(gpu::Context& context, const CheckedFeatures& features);

// Stores the results of the checks for the next call of prove_device().
void keep_proof(gpu::Context& context, const CheckedFeatures& features, std::span<const CheckResult> results);

}  // namespace wavetracer
