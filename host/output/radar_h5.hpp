// SPDX-License-Identifier: Apache-2.0
// Writes radar.h5: what the radars of the configuration receive. radar_h5.cpp lists the layout, with the same words
// that the file contains.
#pragma once
#include <string>
#include <vector>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// As for paths.h5: one writes the parts that do not grow with frames, the other the rows of a frame.
void encode_radar_head_h5(const Run& run, hdf5::File& file);
void append_radar_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
std::vector<std::string> growing_radar_groups(const std::vector<RadarConfig>& radars);

}  // namespace wavetracer
