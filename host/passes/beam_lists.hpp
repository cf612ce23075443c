// SPDX-License-Identifier: Apache-2.0
// The lists of discovery by beams: apertures of one depth and of the next, the candidates that may be seen through
// those of this depth, in chunks, and the pieces of candidates that take long.
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/beams.h"

namespace wavetracer {

struct BeamLists {
  explicit BeamLists(gpu::Context& context)
      : counters(context.buffer<wt_beam_counters>(1, "beam counters")),
        no_outlooks(context.buffer<wt_outlook>(1, "beam outlooks")) {}
  gpu::Buffer<wt_aperture> apertures, next;
  gpu::Buffer<wt_lit_space> lit_spaces;  // those that the last call of beam_gather made
  gpu::Buffer<wt_chunk> chunks;
  gpu::Buffer<wt_beam_candidate> candidates;      // WT_CHUNK for each chunk
  gpu::Buffer<wt_waiting_piece> pieces, waiting;  // those that beam_waiting takes, and those that it leaves
  gpu::Buffer<wt_beam_counters> counters;
  gpu::Buffer<wt_outlook> no_outlooks;
};

// The way that a depth is looked at.
struct BeamStep {
  uint32_t depth = 1, max_depth = 1;  // at the last depth no apertures are made
  uint32_t walls = 0;                 // surfaces that are not opaque that a wave may have passed before this depth
  bool edges = false;                 // edges diffract, so facets in whose plane an image lies count too
  uint32_t root = 0;                  // the node that the walk through the tree begins at
  gpu::Buffer<wt_outlook>* outlooks = nullptr;  // gets what each aperture remembers; null: nothing is remembered
};

// The power that beams keep at mirrors, and that below which they are not followed.
struct BeamMirrors {
  gpu::Buffer<float> reflectances;     // bounds, WT_COSINES for each material
  gpu::Buffer<uint32_t> materials_of;  // the material of each surface of the world
  wt_floor floor;
};

}  // namespace wavetracer
