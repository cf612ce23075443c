// SPDX-License-Identifier: Apache-2.0
// grazed_faces: enters the faces that ends see at grazing, past edges of faces that their rays have met.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/grazed_faces.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/sequences.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class GrazedFaces {
 public:
  // ages: are those of sequences kept?
  GrazedFaces(gpu::Context& context, bool ages);
  // A pass for Sequences::extend.
  void operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                  const Sequences::Found& found);

 private:
  gpu::Context& context_;
  Work work_;
  gpu::KernelOf<calls::grazed_faces::grazed_faces> kernel_;
};

}  // namespace wavetracer
