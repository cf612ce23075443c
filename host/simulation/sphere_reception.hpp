// SPDX-License-Identifier: Apache-2.0
// The thesis' method of reception: a receiver is a sphere, and a ray that passes through it makes a path, without a
// solve. Among the rays of one sequence the one that passes nearest is kept; its path goes over its own points to the
// receiver's centre. A ray that passes at distance b makes it too long by about b^2 r1 / (2 r2 (r1 + r2)), where r1 and
// r2 are the lengths before and after its last point.
#pragma once
#include <map>
#include <tuple>
#include <vector>

#include "passes/receive.hpp"
#include "passes/waypoints.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

class SphereReception {
 public:
  SphereReception(gpu::Context& context, double radius_m) : receive_(context, radius_m) {}
  // Removes all paths.
  void begin_launch();
  // Removes the receptions of the batch so far.
  void begin_batch() { receive_.begin_batch(); }
  // Ends a batch of which all segments have been received: keeps receptions that are nearer than before, and returns
  // all.
  std::vector<wt_reception> end_batch(Waypoints& waypoints);
  // The number of receptions of all batches.
  uint64_t count() const { return count_; }
  // The paths in the order of their links and surfaces.
  PathGeometry paths() const;
  Receive& receive() { return receive_; }

 private:
  struct Kept {
    float distance_m;
    std::vector<glm::dvec3> points;
  };
  using Key = std::tuple<uint32_t, uint32_t, std::vector<uint32_t>>;  // transmitter, receiver, surfaces

  Receive receive_;
  std::map<Key, Kept> kept_;
  uint64_t count_ = 0;
};

}  // namespace wavetracer
