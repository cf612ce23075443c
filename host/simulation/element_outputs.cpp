// SPDX-License-Identifier: Apache-2.0
// Outputs are only made if the configuration asks for them.
#include "simulation/element_outputs.hpp"

#include "radio/element_responses.hpp"

namespace wavetracer {

ElementOutputs::ElementOutputs(const Config& config, const Scene& scene, const World& world) : config_(config) {
  if (has_beams(config)) beams_.emplace(config);
  if (beams_ || config.response.bandwidth_hz) model_.emplace(config, scene, world.fleet.models, world.fleet.instances);
}

void ElementOutputs::operator()(FrameResult& frame) const {
  if (config_.response.bandwidth_hz) frame.responses = make_responses(*model_, config_, frame);
  if (beams_) frame.beams = beams_->gains(*model_, frame);
}

}  // namespace wavetracer
