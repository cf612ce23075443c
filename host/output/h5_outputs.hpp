// SPDX-License-Identifier: Apache-2.0
// The HDF5 files of a run: the name of each, whole and in shards, and the functions that make it from a run and its
// frames.
#pragma once
#include <string>
#include <vector>
#include "output/frame_tables.hpp"
#include "output/hdf5.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

struct H5Output {
  const char* name;
  const char* part_suffix;  // suffix of a shard's part of it: frames_FIRST_LAST followed by this
  // Writes the parts that do not grow with frames into an empty file in memory; call it through make_head()
  // (head_h5.hpp).
  void (*encode_head)(const Run&, hdf5::File&);
  // Appends the rows of a frame. Throws RuntimeError if its columns contradict each other.
  void (*append_frame)(const Run&, const FrameResult&, FrameTables&);
  std::vector<std::string> growing_groups;  // in the order of the file
};

inline constexpr size_t most_h5_outputs = 7;  // number of outputs that exist

// Returns the files that runs of this configuration write: paths.h5; waypoints.h5 with output.waypoints;
// cache_entries.h5 with output.cache_entries; responses.h5 with response.bandwidth_hz; beams.h5 with array.codebook;
// carriers.h5 with more than one of radio.frequencies_hz; radar.h5 with [[radar]].
std::vector<H5Output> h5_outputs(const Config& config);

}  // namespace wavetracer
