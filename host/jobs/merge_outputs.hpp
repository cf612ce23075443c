// The parts of a run, made its outputs: what Shards and `wavetracer merge` share.
// Of the parts, memory holds a block of rows at most.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>
#include "base/pending_file.hpp"
#include "jobs/merge_ahead.hpp"
#include "jobs/merge_parts.hpp"
#include "output/h5_outputs.hpp"

namespace wavetracer {

// Writes what of an output does not grow with frames.
using WriteHead = std::function<void(const H5Output&, const std::filesystem::path& first_part, hdf5::File&)>;

// Whose parts they are: those of others are read in a child process (limited_child.hpp).
enum class Parts { own, foreign };

// Whether all rows are read back and compared with those of the parts.
enum class Proof { none, rows };

// Is called with the whole table of links, beside the rest of a merge.
using ReadLinks = std::function<void(const std::filesystem::path&)>;

// Synced, but not in place: the HDF5 outputs, then links.csv. config: output.waypoints and output.compression alone are
// used. ahead: what is done of it already, of own parts. Throws InputError that names the part that cannot be merged,
// and RuntimeError.
std::vector<PendingFile> merge_outputs(
    const Config& config, const MergeParts& parts, Parts whose, Proof proof, const std::filesystem::path& directory,
    const WriteHead& write_head, MergeAhead* ahead = nullptr,
    const ReadLinks& read_links = [](const std::filesystem::path&) {});

}  // namespace wavetracer
