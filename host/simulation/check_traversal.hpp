// SPDX-License-Identifier: Apache-2.0
// Checks of traversal: rays through the scene on the device, against every triangle on the host.
#pragma once
#include "simulation/check_result.hpp"
#include "simulation/setup.hpp"

namespace wavetracer {

// state: the state in which the vehicles of the setup have been placed.
CheckResult check_traversal(Setup& setup, const WorldState& state);

}  // namespace wavetracer
