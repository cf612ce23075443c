// SPDX-License-Identifier: Apache-2.0
// A radar receives the paths of one of its links: from them to detections.
#pragma once
#include "wavetracer/arrays.hpp"
#include "wavetracer/radar.hpp"

namespace wavetracer {

// config: with all ends of the world. link: one of the frame. axes: those of its antennas. with_cube: else the row has
// no cube. The result does not depend on the number of cores.
RadarRow radar_row(const ElementModel& model, const Config& config, const FrameResult& frame, Link link,
                   const RadarConfig& radar, const RadarAxes& axes, bool with_cube);

}  // namespace wavetracer
