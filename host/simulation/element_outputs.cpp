// SPDX-License-Identifier: Apache-2.0
// Outputs are only made if the configuration asks for them.
#include "simulation/element_outputs.hpp"

#include <fmt/format.h>

#include "radar/radar_rows.hpp"
#include "radio/element_responses.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Limit of the cells that all links of a frame keep. A cell of a cube and of its map takes up to 24 bytes in the frame
// that is computed, 24 in the one that is written meanwhile, and 8 in the writer's copy of a column; the link that is
// computed takes up to 1.5 GiB more. So a run needs at most 7 GiB for its radars.
constexpr uint64_t most_radar_cells = uint64_t{3} << 25;

}  // namespace

ElementOutputs::ElementOutputs(const Config& config, const Scene& scene, const World& world,
                               const std::vector<WorldRadar>& radars)
    : config_(config), radars_(radars), radars_at_once_(!radars.empty() && !world.live) {
  if (has_beams(config)) beams_.emplace(config);
  if (beams_ || config.response.bandwidth_hz || !radars.empty())
    model_.emplace(config, scene, world.fleet.models, world.fleet.instances);
}

void ElementOutputs::operator()(FrameResult& frame) const {
  if (config_.response.bandwidth_hz) frame.responses = make_responses(*model_, config_, frame);
  if (beams_) frame.beams = beams_->gains(*model_, frame);
  if (radars_at_once_) frame.radars = radars(frame, CubesKept::configured);
}

bool ElementOutputs::keeps_cube(size_t radar, CubesKept cubes) const {
  return cubes == CubesKept::all || (cubes == CubesKept::configured && config_.radars[radar].cube);
}

uint64_t ElementOutputs::radar_cells(const FrameResult& frame, CubesKept cubes) const {
  uint64_t out = 0;
  for (size_t i = 0; i < radars_.size(); ++i) {
    const RadarAxes& axes = radars_[i].axes;
    const uint64_t pairs = keeps_cube(i, cubes) ? uint64_t{axes.rx_antennas} * axes.tx_antennas : 1;
    out += links_in(radars_[i], frame.world.links).size() * pairs * axes.doppler_hz.size() * axes.delay_s.size();
  }
  return out;
}

std::vector<RadarRows> ElementOutputs::radars(const FrameResult& frame, CubesKept cubes) const {
  if (const uint64_t cells = radar_cells(frame, cubes); cells > most_radar_cells)
    throw RuntimeError(fmt::format(
        "the radars of frame {} have {} cells of all links, and {} are the limit: {}let radar.transmitter and "
        "radar.receiver name fewer ends, or give fewer radar.chirps or radar.samples",
        frame.frame, cells, most_radar_cells,
        cubes == CubesKept::configured ? "give radar.cube = false, or "
        : cubes == CubesKept::all      ? "ask for no cubes, or "
                                       : ""));
  std::vector<RadarRows> out(radars_.size());
  for (size_t i = 0; i < radars_.size(); ++i)
    for (const Link& link : links_in(radars_[i], frame.world.links))
      out[i].push_back(
          radar_row(*model_, config_, frame, link, config_.radars[i], radars_[i].axes, keeps_cube(i, cubes)));
  return out;
}

}  // namespace wavetracer
