// SPDX-License-Identifier: Apache-2.0
// Merges the parts of a run into its outputs, for Shards and `wavetracer merge`.
// At most one block of rows is in memory.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/merge_ahead.hpp"
#include "output/h5_outputs.hpp"

namespace wavetracer {

// The names of the files from which the outputs of a run are made.
struct MergeParts {
  // [file][part]: the files of h5_outputs() in their order, then .csv; parts in the order of their units, at least one.
  std::vector<std::vector<std::filesystem::path>> files;
  bool of_one_frame = false;  // parts are blocks of transmitters, in their order
};

// Writes the parts of an output that do not grow with frames.
using WriteHead = std::function<void(const H5Output&, const std::filesystem::path& first_part, hdf5::File&)>;

// The origin of the parts: foreign ones are read in a child process (limited_child.hpp).
enum class Parts { own, foreign };

// Tells whether all rows are read back and compared with those of the parts.
enum class Proof { none, rows };

// Called with the whole table of links, in parallel with the rest of a merge.
using ReadLinks = std::function<void(const std::filesystem::path&)>;

// Returns the files, synced but not in place: the HDF5 outputs, then links.csv. config: only output.waypoints and
// output.compression are used. ahead: the work that is done already, for own parts. Throws InputError that names the
// part that cannot be merged, and RuntimeError.
std::vector<PendingFile> merge_outputs(
    const Config& config, const MergeParts& parts, Parts whose, Proof proof, const std::filesystem::path& directory,
    const WriteHead& write_head, MergeAhead* ahead = nullptr,
    const ReadLinks& read_links = [](const std::filesystem::path&) {});

}  // namespace wavetracer
