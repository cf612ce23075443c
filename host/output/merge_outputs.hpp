// The parts of a run, made its outputs: what Shards and `wavetracer merge` share.
// Of the parts, memory holds a block of rows at most.
#pragma once
#include <filesystem>
#include <functional>
#include <vector>
#include "output/h5_outputs.hpp"
#include "output/merge_parts.hpp"
#include "output/pending_file.hpp"

namespace wavetracer {

// Writes what of an output does not grow with frames.
using WriteHead = std::function<void(const H5Output&, hdf5::File&)>;

// Synced, but not in place: the HDF5 outputs, then links.csv. config: output.waypoints alone is used. Throws
// RuntimeError.
std::vector<PendingFile> merge_outputs(const Config& config, const MergeParts& parts,
                                       const std::filesystem::path& directory, const WriteHead& write_head);

// The head of an output that is there: all that is not in its growing groups.
void copy_head(const std::filesystem::path& file, const H5Output& output, hdf5::File& head);

// That the parts of an output can be merged, whoever wrote them: the same datasets, of the same types and shapes but
// for their rows, all of them there. Throws RuntimeError that names the file and the dataset.
void check_parts(const H5Output& output, const std::vector<std::filesystem::path>& files);

}  // namespace wavetracer
