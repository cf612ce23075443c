// SPDX-License-Identifier: Apache-2.0
// Writes the world into paths.h5: /transmitters, /receivers and /instances, and the positions of all of them in each
// frame. Positions are in file coordinates.
#pragma once
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

void write_instances(hdf5::File& file, const Run& run);
void write_ends(hdf5::File& file, const Run& run);
// Writes nothing where there are no targets.
void write_targets(hdf5::File& file, const Run& run);
// Appends the rows of a frame.
void append_frame(const Run& run, const FrameResult& frame, FrameTables& tables);
void append_poses(const Run& run, const FrameResult& frame, FrameTables& tables);
void append_links(const FrameResult& frame, FrameTables& tables);

}  // namespace wavetracer
