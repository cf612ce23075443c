// SPDX-License-Identifier: Apache-2.0
// Derivatives of the paths of a frame, by materials that have names.
#pragma once
#include <span>

#include "gradient/path_gradient.hpp"
#include "gradient/recorded_geometry.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/gradient.hpp"

namespace wavetracer {

class FrameGradient {
 public:
  // It takes the arguments of GradientModel, and keeps references to the scene, the models and the instances.
  FrameGradient(const Scene& scene, const Config& config, std::span<const Scene> models,
                std::span<const Instance> instances);

  // Returns the derivatives of the rows of frame.paths at the first carrier. Throws ConfigError for a row in
  // choice.paths that the frame does not have, and RuntimeError for paths of another world.
  PathGradients operator()(const FrameResult& frame, const GradientChoice& choice);

 private:
  GradientModel model_;
  RecordedGeometry geometry_;
};

}  // namespace wavetracer
