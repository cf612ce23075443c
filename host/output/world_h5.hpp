// The world in paths.h5: /transmitters, /receivers and /instances, and where all of them are in each frame.
// Positions are in file coordinates.
#pragma once
#include "output/hdf5.hpp"
#include "output/output.hpp"

namespace wavetracer {

void write_instances(hdf5::File& file, const Run& run);
void write_ends(hdf5::File& file, const Run& run);
void write_frames(hdf5::File& file, const Run& run, Frames frames);
void write_poses(hdf5::File& file, const Run& run, Frames frames);
void write_links(hdf5::File& file, Frames frames);

}  // namespace wavetracer
