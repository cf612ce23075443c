// SPDX-License-Identifier: Apache-2.0
// Writes paths.h5: every path of a run with its vertices, the world around it, and all that is needed to read them
// without wavetracer. paths_h5.cpp and world_h5.cpp list the layout, dataset by dataset, with the same words that the
// file contains.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Writes the parts that do not grow with frames into an empty file in memory. Throws RuntimeError.
void encode_head_h5(const Run& run, hdf5::File& file);

// Appends the rows of a frame; these groups contain nothing else. Datasets get one row for the frame, each path, ...;
// those called NAME_offset begin with 0 and end with the number of rows that they point into. Throws RuntimeError if
// the frame contradicts itself or the run.
void append_frame_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_groups{"/frames", "/links", "/paths", "/poses", "/vertices"};

}  // namespace wavetracer
