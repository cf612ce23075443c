// SPDX-License-Identifier: Apache-2.0
// Outputs are only made if the configuration asks for them.
#include "simulation/element_outputs.hpp"

#include "radar/radar_rows.hpp"
#include "radio/element_responses.hpp"

namespace wavetracer {

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
  std::vector<RadarRows> out;
  for (size_t i = 0; i < radars_.size(); ++i) {
    RadarRows& rows = out.emplace_back();
    const RadarConfig& radar = config_.radars[i];
    for (const Link& link : links_in(radars_[i], frame.world.links))
      rows.push_back(radar_row(*model_, config_, frame, link, radar, radars_[i].axes, with_cubes || radar.cube));
  }
  return out;
}

}  // namespace wavetracer
