// The table of HDF5 outputs. Those that are not always written come last.
// Assumes that the frames of a part fit in memory.
#include "output/h5_outputs.hpp"
#include <array>
#include "output/paths_h5.hpp"
#include "output/waypoints_h5.hpp"

namespace wavetracer {
namespace {

constexpr std::array<H5Output, 2> outputs{
    {{"paths.h5", ".h5", encode_paths_h5, encode_head_h5, growing_groups},
     {"waypoints.h5", ".waypoints.h5", encode_waypoints_h5, encode_waypoints_head_h5, growing_waypoint_groups}}};

}  // namespace

std::span<const H5Output> h5_outputs(const Config& config) {
  return std::span(outputs).first(config.output.waypoints > 0 ? 2 : 1);
}

PendingFile write_whole(const H5Output& output, const Run& run, Frames frames, const std::filesystem::path& path) {
  hdf5::File file;
  output.encode(run, frames, file);
  return PendingFile(path, file.image());
}

}  // namespace wavetracer
