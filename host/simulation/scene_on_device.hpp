// SPDX-License-Identifier: Apache-2.0
// A scene on the device with the instances of a world where they are in the first frame.
#pragma once
#include "simulation/placement.hpp"
#include "simulation/world.hpp"

namespace wavetracer {

struct SceneOnDevice {
  DeviceScene scene;
  std::optional<InstancePlacement> placement;  // only if there are instances
};

// Returns the scene, which is that of `still`, with all instances of the world where they are in the first frame.
// opaque: see with_instances().
inline SceneOnDevice place_instances(gpu::Context& context, DeviceScene scene, const Scene& still, const World& world,
                                     const std::vector<bool>& opaque = {}) {
  const Fleet& fleet = world.fleet;
  if (fleet.instances.empty()) return {std::move(scene), {}};
  auto [all, place] = with_instances(context, std::move(scene), still, fleet.models, fleet.instances, opaque);
  InstancePlacement placement(context, std::move(place), fleet.instances.size());
  placement.place(all, world.state(0).instances);
  return {std::move(all), std::move(placement)};
}

}  // namespace wavetracer
