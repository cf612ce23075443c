// paths.h5: every path of a run with its vertices, the world around it, and what reading them without wavetracer takes.
// The layout is listed in paths_h5.cpp and world_h5.cpp, dataset by dataset, in the words that the file itself carries.
#pragma once
#include <array>
#include "output/hdf5.hpp"
#include "output/output.hpp"

namespace wavetracer {

// Fills an empty file in memory, whose image() then is the bytes of a paths.h5 of these frames. Throws RuntimeError.
void encode_paths_h5(const Run& run, Frames frames, hdf5::File& file);

// The same in two parts: what does not grow with frames, and what does, which is all there is in these groups. Datasets
// of the latter have one row more a frame, path, ...; those called NAME_offset begin with 0 and end with the number of
// rows that they point into.
void encode_head_h5(const Run& run, hdf5::File& file);
void encode_frames_h5(const Run& run, Frames frames, hdf5::File& file);
inline constexpr std::array growing_groups{"/frames", "/links", "/paths", "/poses", "/vertices"};

}  // namespace wavetracer
