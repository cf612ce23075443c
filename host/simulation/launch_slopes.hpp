// SPDX-License-Identifier: Apache-2.0
// Directions of the launch "horizon": its rays go to the slopes that paths can have. Walls are vertical, so a path
// keeps its slope at every wall: it climbs the difference of its ends' heights, or falls to the ground and rises from
// there, over its unfolded horizontal length L. With L anywhere up to the reach R of the scene, the density of slopes
// of a height difference H is flat below H / R and falls as 1 / z^2 beyond. Each launcher gets the mixture of this for
// the ends that it is linked to, straight and by way of the ground, and a uniform share for things above and below.
// Where H is not small against R (a room, a drone), the mixture becomes the uniform launch.
#pragma once
#include <array>
#include <compare>
#include <map>
#include <vector>

#include "passes/launch_heights.hpp"
#include "simulation/listeners.hpp"
#include "simulation/surroundings.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// The number of paths that climb and fall by each height: half octaves, the first up to 2.8 m, the last from 1.4 km.
struct SlopeCounts {
  static constexpr uint32_t bins = 20;
  std::array<uint32_t, bins> up{}, down{};
  auto operator<=>(const SlopeCounts&) const = default;
};

struct SlopeTables {
  std::vector<uint32_t> of_origin;  // table of each origin
  std::vector<float> values;        // in the form that LaunchHeights takes
};

class LaunchSlopes {
 public:
  // around outlives this. reach_m: that of paths, where it is more than the diagonal of the scene's plan.
  LaunchSlopes(const Surroundings& around, double reach_m);
  // Tables for the origins of this frame's links.
  SlopeTables tables(const WorldState& world, const Origins& origins);

 private:
  // Height of the ground under an end; for fixed origins it is remembered.
  double ground_m(uint32_t origin, const EndState& end, const WorldState& world);

  struct Ground {
    glm::dvec3 position_m{std::numeric_limits<double>::quiet_NaN()};
    double height_m = 0;
  };
  const Surroundings& around_;
  double reach_m_;
  std::vector<Ground> ground_;
  std::map<SlopeCounts, uint32_t> known_;
  std::vector<float> values_;
};

}  // namespace wavetracer
