// SPDX-License-Identifier: Apache-2.0
// The outputs of a frame between the elements of arrays: responses ([response]) and gains of beams (array.codebook).
#pragma once
#include <optional>

#include "radio/beams.hpp"
#include "simulation/world.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

class ElementOutputs {
 public:
  // config: has all ends of the world. All arguments must outlive this. Reads codebooks; throws ConfigError or
  // InputError.
  ElementOutputs(const Config& config, const Scene& scene, const World& world);
  // Does a frame get any of these outputs?
  bool on() const { return model_.has_value(); }
  // Adds them to a frame that is complete otherwise.
  void operator()(FrameResult& frame) const;

 private:
  const Config& config_;
  std::optional<ElementModel> model_;
  std::optional<Beams> beams_;
};

}  // namespace wavetracer
