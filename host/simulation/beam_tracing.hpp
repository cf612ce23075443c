// SPDX-License-Identifier: Apache-2.0
// Discovery by beams: the sequences of surfaces that an end can see in its mirrors, all of them down to a depth, except
// for beams that are too thin to follow, whose solid angle is told (docs/design/beams.md).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "passes/beam_gather.hpp"
#include "passes/beam_visible.hpp"
#include "passes/sequences.hpp"
#include "radio/reflectance_bounds.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/launch.hpp"

namespace wavetracer {

// The first apertures of beams: the six faces of a cube around each end.
std::vector<wt_aperture> beam_roots(std::span<const Launcher> ends);

struct BeamOptions {
  uint32_t max_transmissions = 0;  // surfaces that are not opaque that a path may pass; each is an interaction too
  uint32_t max_diffractions = 0;   // edges that a path may go over; 0: edges do not diffract
  ReflectanceBounds mirrors;       // those of the surfaces of the world
  // The gain between isotropic antennas below which a path need not be found, and the wavelength that it is for.
  std::optional<double> floor_db = {};
  double wavelength_m = 1;
};

// The mirrors of the options; floor gets its box of receivers with each discovery.
BeamMirrors make_beam_mirrors(gpu::Context& context, const BeamOptions& options);

class BeamTracing {
 public:
  BeamTracing(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models, const BeamOptions& options,
              const FrameWatch* watch = nullptr);
  // Places the instances, before the first discovery and whenever they have moved.
  void set_world(const std::vector<Instance>& instances, std::span<const Placement> placements);
  // Enters all sequences of at most max_depth surfaces that these ends see, with every quarter, unless all paths over
  // them to receivers at these places (recentred, m) are too weak. scene: with the surfaces that the triangles name.
  BeamCounts find(const DeviceScene& scene, const std::vector<Launcher>& ends, std::span<const glm::dvec3> receivers,
                  uint32_t max_depth, Sequences& set);

 private:
  // Looks through all apertures of a depth. Returns false if the set must grow, and all must begin again.
  bool look(const DeviceScene& scene, uint32_t apertures, const BeamStep& step, Sequences& set);
  // Makes the roots of all ends the apertures, and returns their number.
  uint32_t start(const std::vector<Launcher>& ends);

  gpu::Context& context_;
  uint32_t max_transmissions_;
  uint32_t max_diffractions_;
  std::optional<double> floor_db_;
  const FrameWatch* watch_;
  WorldFacets facets_;
  BeamTree tree_;
  std::optional<BeamGather> gather_;
  std::optional<BeamVisible> visible_;
  uint32_t depth_ = 0;  // the trees of this depth that gather_ can walk
  BeamLists lists_;
  BeamMirrors mirrors_;
  BeamCounts counts_;
};

}  // namespace wavetracer
