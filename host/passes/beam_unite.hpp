// SPDX-License-Identifier: Apache-2.0
// beam_unite: apertures of one sequence that make up a convex part of their mirror become one.
#pragma once
#include "kernel_calls/beam_unite.hpp"
#include "passes/beam_lists.hpp"
#include "passes/device_scene.hpp"
#include "passes/trie.hpp"

namespace wavetracer {

class BeamUnite {
 public:
  explicit BeamUnite(gpu::Context& context);
  // Makes lists.apertures from the first `count` of lists.next, and returns their number. Sequences are slots of the
  // set. The counter of apertures is 0 after it.
  uint32_t operator()(const DeviceScene& scene, BeamLists& lists, uint32_t count, const Trie& set);

 private:
  gpu::Context& context_;
  uint32_t lanes_;
  gpu::KernelOf<calls::beam_unite::beam_link> link_;
  gpu::KernelOf<calls::beam_unite::beam_unite> unite_;
  gpu::Buffer<uint32_t> last_, before_;  // the last aperture of each sequence, and for each aperture the one before
};

}  // namespace wavetracer
