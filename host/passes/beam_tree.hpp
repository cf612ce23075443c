// SPDX-License-Identifier: Apache-2.0
// The facets of a world at one instant, in double, and a tree over them that is the same on every device: the input of
// discovery by beams (beam_gather, beam_visible).
#pragma once
#include "gpu/gpu.hpp"
#include "passes/beam_facets.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

// Node fixed_root is the root of the facets that do not move, and node 0 that of all. Leaves of the former name the
// first facets.
struct BeamTree {
  gpu::Buffer<wt_bvh2_node> nodes;
  gpu::Buffer<wt_facet> facets;  // in the order of the leaves
  gpu::Buffer<double> corners;   // three doubles each, in the order of the facets
  uint32_t depth = 0;            // nodes from node 0 to a leaf, at most; a leaf has one facet
  bool has_moving = false;       // else node 0 has no other facets than fixed_root
  static constexpr uint32_t fixed_root = 1;
  uint32_t root() const { return has_moving ? 0 : fixed_root; }
};

// A tree whose fixed part is made once, and whose moving part again and again.
class BeamTreeBuilder {
 public:
  // Throws InputError for a coordinate that float32 cannot hold.
  BeamTreeBuilder(gpu::Context& context, const Facets& fixed);
  // Puts these facets beside the fixed ones, in place of those of the call before.
  void place(const Facets& moving);
  const BeamTree& tree() const { return tree_; }

 private:
  gpu::Context& context_;
  BeamTree tree_;
  wt_bvh2_node top_{};  // node 0, whose right child is the moving part
  size_t fixed_nodes_ = 0, fixed_facets_ = 0, fixed_corners_ = 0;
  uint32_t fixed_depth_ = 0;
};

// The tree of facets that do not move. Throws InputError for a coordinate that float32 cannot hold.
BeamTree make_beam_tree(gpu::Context& context, const Facets& fixed);

}  // namespace wavetracer
