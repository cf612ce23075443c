// paths.h5: every path of a run with its vertices, the world around it, and what reading them without wavetracer takes.
// The layout is listed in paths_h5.cpp and world_h5.cpp, dataset by dataset, in the words that the file itself carries.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// What does not grow with frames, into an empty file in memory. Throws RuntimeError.
void encode_head_h5(const Run& run, hdf5::File& file);

// What does, which is all there is in these groups: the rows of a frame. Datasets have one row more a frame, path, ...;
// those called NAME_offset begin with 0 and end with the number of rows that they point into. Throws RuntimeError where
// the frame contradicts itself or the run.
void append_frame_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_groups{"/frames", "/links", "/paths", "/poses", "/vertices"};

}  // namespace wavetracer
