// SPDX-License-Identifier: Apache-2.0
// Checks of the passes on lists of words, against the host's own: sorts and prefix sums.
#pragma once
#include "gpu/gpu.hpp"
#include "simulation/check_result.hpp"

namespace wavetracer {

// Checks stable sorts of few keys, by the bitonic network, and of many, by digits.
CheckResult check_sorts(gpu::Context& context);
CheckResult check_sums(gpu::Context& context);

}  // namespace wavetracer
