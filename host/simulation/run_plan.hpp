// SPDX-License-Identifier: Apache-2.0
// The plan of a run: everything that is known before any device is asked, as one value that is made of the
// configuration and the scene.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "simulation/listeners.hpp"
#include "simulation/world.hpp"
#include "simulation/world_radars.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

struct RunPlan {
  Scene scene;
  World world;
  // The configuration as it was given, with all ends of the world. Its trace is what messages and outputs speak of;
  // what is computed follows from the one below.
  Config asked;
  Features features;
  TraceConfig trace;  // [trace] without what the scene does not need
  Origins origins;
  std::vector<WorldRadar> radars;  // one for each [[radar]]
  bool reuse;                      // frames reuse the sequences that rays of earlier frames have found
  bool keep_beams;                 // frames reuse the beams of ends that stand

  // Rays may meet something.
  bool has_surfaces() const { return !scene.surfaces.empty() || !world.fleet.instances.empty(); }
  // `asked` with `trace`, for what needs all of a configuration. It copies all ends.
  Config computed() const;
};

// frames_follow: frames of poses of the caller's own follow each other, also where the world has one frame; then they
// reuse sequences if trace.reuse says so. Throws ConfigError or InputError.
RunPlan plan_run(const Config& asked, Scene scene, bool frames_follow);

// Returns a flag for each surface of the world: no wave of any carrier passes it. The list is empty if waves pass no
// walls at all.
std::vector<bool> opaque_surfaces(const RunPlan& plan);

// Returns the places of the transmitters in the first frame, in recentred metres.
std::vector<glm::dvec3> first_transmitters(const World& world);

}  // namespace wavetracer
