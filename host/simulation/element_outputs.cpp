// SPDX-License-Identifier: Apache-2.0
// Outputs are only made if the configuration asks for them.
#include "simulation/element_outputs.hpp"

#include <fmt/format.h>

#include "radar/radar_rows.hpp"
#include "radio/element_responses.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t most_radar_cells = uint64_t{1} << 29;  // 8 GiB in a frame

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
  if (radars_at_once_) frame.radars = radars(frame, false);
}

std::vector<RadarRows> ElementOutputs::radars(const FrameResult& frame, bool with_cubes) const {
  std::vector<std::vector<Link>> links;
  uint64_t cells = 0;  // those that stay in memory
  for (size_t i = 0; i < radars_.size(); ++i) {
    const RadarAxes& axes = radars_[i].axes;
    const uint64_t pairs = with_cubes || config_.radars[i].cube ? uint64_t{axes.rx_antennas} * axes.tx_antennas : 1;
    links.push_back(links_in(radars_[i], frame.world.links));
    cells += links.back().size() * pairs * axes.doppler_hz.size() * axes.delay_s.size();
  }
  if (cells > most_radar_cells)
    throw RuntimeError(fmt::format(
        "the radars of frame {} have {} cells of all links, and {} are the limit: give radar.cube = false, or "
        "let radar.transmitter and radar.receiver name fewer ends",
        frame.frame, cells, most_radar_cells));
  std::vector<RadarRows> out(radars_.size());
  for (size_t i = 0; i < radars_.size(); ++i)
    for (const Link& link : links[i])
      out[i].push_back(radar_row(*model_, config_, frame, link, config_.radars[i], radars_[i].axes,
                                 with_cubes || config_.radars[i].cube));
  return out;
}

}  // namespace wavetracer
