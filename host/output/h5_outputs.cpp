// The table of HDF5 outputs. Those that are not always written come last.
// Merging reserves the room that the parts take before HDF5 writes, which may crash where a disk is full.
#include "output/h5_outputs.hpp"
#include <array>
#include "output/merge_h5.hpp"
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

PendingFile merge_parts(const H5Output& output, const Run& run, std::span<const std::filesystem::path> parts,
                        const std::filesystem::path& path) {
  PendingFile file(path);
  hdf5::File head;
  output.encode_head(run, head);
  const auto image = head.image();
  file.write(image);
  constexpr uint64_t slack = uint64_t{1} << 20;  // for the tables of contents
  uint64_t size = image.size() + slack;
  for (const std::filesystem::path& part : parts) size += std::filesystem::file_size(part);
  file.reserve(size);
  {
    hdf5::File merged = hdf5::File::open_to_write(file.temporary());
    merge_frames_h5(parts, output.growing_groups, merged);
    merged.flush();
  }
  file.sync();
  return file;
}

}  // namespace wavetracer
