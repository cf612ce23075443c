// SPDX-License-Identifier: Apache-2.0
// The surfaces of a world, as far as ray caches ask for them.
#pragma once
#include "passes/device_scene.hpp"

namespace wavetracer {

// The surfaces by which a look-up judges an entry: the planes and bounds of hit_point = "own" (float), and the
// instances of scope = "all" (exact). They may be null where the table asks for neither.
struct CacheSurfaces {
  CacheSurfaces(const gpu::Buffer<wt_surface>* in_float, const gpu::Buffer<wt_exact_surface>* in_double)
      : surfaces(in_float), exact(in_double) {}
  CacheSurfaces(const DeviceScene& scene) : CacheSurfaces(&scene.surfaces, &scene.exact_surfaces) {}
  const gpu::Buffer<wt_surface>* surfaces;
  const gpu::Buffer<wt_exact_surface>* exact;
};

}  // namespace wavetracer
