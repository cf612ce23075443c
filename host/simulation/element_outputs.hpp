// What a frame has between the elements of arrays: responses ([response]) and gains of beams (array.codebook).
#pragma once
#include <optional>

#include "radio/beams.hpp"
#include "simulation/world.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

class ElementOutputs {
 public:
  // config: with all ends of the world. All of them must outlive it. Reads codebooks; throws ConfigError or InputError.
  ElementOutputs(const Config& config, const Scene& scene, const World& world);
  // Whether a frame gets anything.
  bool on() const { return model_.has_value(); }
  // Of a frame that is complete but for them.
  void operator()(FrameResult& frame) const;

 private:
  const Config& config_;
  std::optional<ElementModel> model_;
  std::optional<Beams> beams_;
};

}  // namespace wavetracer
