// SPDX-License-Identifier: Apache-2.0
// The facets of a world at one instant, in double, and a tree over them that is the same on every device: the input of
// discovery by beams (beam_gather, beam_visible).
#pragma once
#include "gpu/gpu.hpp"
#include "passes/beam_facets.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

struct BeamTree {
  gpu::Buffer<wt_bvh2_node> nodes;
  gpu::Buffer<wt_facet> facets;  // in the order of the leaves
  gpu::Buffer<double> corners;   // three doubles each, in the order of the facets
  uint32_t depth = 0;            // nodes from the root to a leaf, at most; a leaf has one facet
};

// Throws InputError for a coordinate that float32 cannot hold.
BeamTree make_beam_tree(gpu::Context& context, const Facets& facets);

}  // namespace wavetracer
