// SPDX-License-Identifier: Apache-2.0
// place: puts vehicles into the scene of a frame: their surfaces for the exact solve, and a top-level tree over the
// instances. The trees of the models are built once; a frame uploads 160 bytes per instance, and 128 more where the
// host builds the tree over them.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "accel/box.hpp"
#include "kernel_calls/place.hpp"
#include "passes/device_scene.hpp"
#include "wavetracer/device/moving.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct PlacedScene;

class Place {
 public:
  // See with_instances().
  static PlacedScene make(gpu::Context& context, DeviceScene scene, const Scene& still,
                          const std::vector<Scene>& models, const std::vector<Instance>& instances,
                          const std::vector<bool>& opaque);
  // Moves all instances, and builds the tree over them on the host; placements are in the order of the instances.
  void operator()(DeviceScene& scene, std::span<const Placement> placements);
  // The same without the tree, if it is built elsewhere (passes/top_level.hpp).
  void surfaces(DeviceScene& scene, std::span<const Placement> placements);
  // The data of instances in such a tree that does not depend on the frame: see instance_keys of top_level.cl.
  std::vector<wt_body> bodies() const;

 private:
  struct Model {
    Box box;  // box of its triangles, in model coordinates
    int32_t root = 0;
    uint32_t first_surface = 0;
  };
  // Makes its own tables; the rest of make() gives `scene` what belongs into it.
  Place(gpu::Context& context, const std::vector<Scene>& models, const std::vector<Instance>& instances,
        const DeviceScene& scene, size_t static_surfaces);
  void upload_surfaces(gpu::Context& context, const Scene& still, const std::vector<Scene>& models,
                       const std::vector<bool>& opaque, DeviceScene& scene);
  void upload_trees(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene);
  void write_top_level(DeviceScene& scene, std::span<const Placement> placements);
  void upload_bvh2(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene);
  void upload_bvh8(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene);
  // Uploads nodes and leaves of all models, and makes room for the top level.
  template <class Node, class Leaf>
  void upload(gpu::Context& context, DeviceScene& scene, const std::vector<Node>& nodes,
              const std::vector<Leaf>& leaves);
  wt_instance instance_record(uint32_t i, const Placement& placement) const;

  gpu::KernelOf<calls::place::place> kernel_;
  uint32_t local_;
  std::vector<Instance> instances_;
  std::vector<uint32_t> first_primitive_;  // one per instance
  std::vector<Model> models_;
  gpu::Buffer<wt_model_surface> model_surfaces_;
  gpu::Buffer<uint32_t> surface_instances_;  // the instance of each surface of instances
  uint32_t first_surface_, surface_count_ = 0;
  size_t instances_at_ = 0;  // place in top_
  uint32_t triangle_slots_ = 0;
  float extent_m_;
  std::vector<wt_exact_instance> records_;  // those of the last frame, as the next ones
  std::vector<uint32_t> present_;
  std::vector<Box> boxes_;
  std::vector<wt_float4> top_;  // tree and instances: the part of `moving` between head and models' trees
};

// A scene in which instances move, and the pass that moves them.
struct PlacedScene {
  DeviceScene scene;
  Place place;
};

// The scene, which is that of `still`, with room for the surfaces of every instance, the models' trees, and the
// definitions that kernels which trace it need. Surfaces of instances follow those of the static scene as
// Instance::first_surface says. At least one instance. opaque: see device_surfaces().
inline PlacedScene with_instances(gpu::Context& context, DeviceScene scene, const Scene& still,
                                  const std::vector<Scene>& models, const std::vector<Instance>& instances,
                                  const std::vector<bool>& opaque = {}) {
  return Place::make(context, std::move(scene), still, models, instances, opaque);
}

}  // namespace wavetracer
