// A device proves itself before it is used: it has passed the checks of device_check.hpp, now or in an earlier start.
#pragma once
#include <span>
#include <string>

#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"

namespace wavetracer {

struct Setup;

// What is checked for a run of this setup. The thesis' tables of a ray cache are as printed, with faults that are
// theirs and not a device's, so they are left out.
CheckedFeatures features_to_check(const Setup& setup);

// Checks the device for these features, unless it has passed before with the same driver, platform, kernels and version
// of the program: that is kept beside the compiled kernels, and where there is no room for those, each call checks.
// Throws DeviceError that names device and driver, what has failed, and what to do.
void prove_device(gpu::Context& context, const CheckedFeatures& features);

// Keeps what the checks have found for the next call of prove_device().
void keep_proof(gpu::Context& context, const CheckedFeatures& features, std::span<const CheckResult> results);

}  // namespace wavetracer
