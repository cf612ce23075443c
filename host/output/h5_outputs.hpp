// The HDF5 files of a run: what each is called, whole and in shards, and how it is written at once.
// A file in memory is all that is held.
#pragma once
#include <filesystem>
#include <span>
#include "output/hdf5.hpp"
#include "output/output.hpp"
#include "output/pending_file.hpp"

namespace wavetracer {

struct H5Output {
  const char* name;
  const char* part_suffix;  // of a shard's part of it: frames_FIRST_LAST and this
  void (*encode)(const Run&, Frames, hdf5::File&);
  void (*encode_head)(const Run&, hdf5::File&);  // what does not grow with frames
  std::span<const char* const> growing_groups;   // what does
};

// Those that runs of this configuration write: paths.h5, and with output.waypoints waypoints.h5.
std::span<const H5Output> h5_outputs(const Config& config);

// Synced, but not in place. Throws RuntimeError.
PendingFile write_whole(const H5Output& output, const Run& run, Frames frames, const std::filesystem::path& path);

}  // namespace wavetracer
