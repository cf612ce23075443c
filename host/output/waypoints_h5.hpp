// waypoints.h5: where samples of the launched rays went, for study and pictures (output.waypoints).
// The layout is listed in waypoints_h5.cpp, in the words that the file itself carries.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// As for paths.h5: what does not grow with frames, and the rows of a frame.
void encode_waypoints_head_h5(const Run& run, hdf5::File& file);
void append_waypoints_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_waypoint_groups{"/waypoints"};

}  // namespace wavetracer
