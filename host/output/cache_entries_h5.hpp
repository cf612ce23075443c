// SPDX-License-Identifier: Apache-2.0
// cache_entries.h5: the entries of the ray cache's table after each frame, for study (output.cache_entries).
// cache_entries_h5.cpp lists the layout, with the same words that the file contains.
#pragma once
#include <array>
#include "output/frame_tables.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// As for paths.h5: one writes the parts that do not grow with frames, the other the rows of a frame.
void encode_cache_entries_head_h5(const Run& run, hdf5::File& file);
void append_cache_entries_h5(const Run& run, const FrameResult& frame, FrameTables& tables);
inline constexpr std::array growing_cache_entry_groups{"/cache_entries"};

}  // namespace wavetracer
