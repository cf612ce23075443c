// The table of HDF5 outputs. Those that are not always written come last.
#include "output/h5_outputs.hpp"
#include <array>
#include "output/paths_h5.hpp"
#include "output/waypoints_h5.hpp"

namespace wavetracer {
namespace {

constexpr std::array<H5Output, 2> outputs{
    {{"paths.h5", ".h5", encode_head_h5, append_frame_h5, growing_groups},
     {"waypoints.h5", ".waypoints.h5", encode_waypoints_head_h5, append_waypoints_h5, growing_waypoint_groups}}};

}  // namespace

std::span<const H5Output> h5_outputs(const Config& config) {
  return std::span(outputs).first(config.output.waypoints > 0 ? 2 : 1);
}

}  // namespace wavetracer
