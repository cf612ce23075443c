// SPDX-License-Identifier: Apache-2.0
// The small world in which devices are checked: two houses, a screen, a rough wall and two vehicles on a square.
// Its numbers are written out. Right angles and ratios of 3, 4 and 5 need no function whose last bit depends on the
// library of a machine, so its paths have the same bits everywhere.
#pragma once
#include "simulation/checked_features.hpp"
#include "simulation/world.hpp"

namespace wavetracer {

Config check_config(const CheckedFeatures& features);
// config: the result of check_config().
Scene check_scene(const Config& config);
// The state of a frame, with the vehicles turned and moving.
WorldState check_state(const World& world);

}  // namespace wavetracer
