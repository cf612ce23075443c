// waypoints.h5: where samples of the launched rays went, for study and pictures (output.waypoints).
// The layout is listed in waypoints_h5.cpp, in the words that the file itself carries.
#pragma once
#include <array>
#include "output/hdf5.hpp"
#include "output/output.hpp"

namespace wavetracer {

// Fills an empty file in memory, whose image() then is the bytes of a waypoints.h5 of these frames. Throws
// RuntimeError.
void encode_waypoints_h5(const Run& run, Frames frames, hdf5::File& file);

// The same in two parts, as for paths.h5: what does not grow with frames, and what does.
void encode_waypoints_head_h5(const Run& run, hdf5::File& file);
void encode_waypoints_frames_h5(Frames frames, hdf5::File& file);
inline constexpr std::array growing_waypoint_groups{"/waypoints"};

}  // namespace wavetracer
