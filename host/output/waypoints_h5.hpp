// SPDX-License-Identifier: Apache-2.0
// waypoints.h5: points of sampled rays, for study and pictures (output.waypoints).
// waypoints_h5.cpp lists the layout, with the same words that the file contains.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// As for paths.h5: one writes the parts that do not grow with frames, the other the rows of a frame.
void encode_waypoints_head_h5(const Run& run, hdf5::File& file);
void append_waypoints_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_waypoint_groups{"/waypoints"};

}  // namespace wavetracer
