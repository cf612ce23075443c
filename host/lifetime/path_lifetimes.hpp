// SPDX-License-Identifier: Apache-2.0
// The distance by which the ends of a path and all bodies may still move before the path can end.
#pragma once
#include <span>
#include <vector>

#include "lifetime/path_motion.hpp"
#include "lifetime/surface_border.hpp"
#include "lifetime/surface_distance.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// No lifetime is larger than this, in metres.
inline constexpr double most_lifetime_m = 100;

class PathLifetimes {
 public:
  // It keeps references to the arguments.
  PathLifetimes(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances);

  // Returns a lower bound for each row of paths, in metres: the path is there as long as both of its ends and all
  // points of all instances are no farther than this from their places in `state`. It is 0 where no bound is known: for
  // paths that scatter or have two diffractions and more, that touch something else, or whose interactions are in one
  // place. path_motion.hpp proves the motion of points; a leg is free while it has moved less than its distance to the
  // nearest surface that it does not end on. It uses all cores.
  std::vector<double> operator()(const Paths& paths, const WorldState& state) const;

 private:
  // A scene or model with what is looked up in it.
  struct Body {
    const Scene* scene;
    SurfaceDistance distance;
    SurfaceBorders borders;
    double width_m;   // h of path_motion.hpp
    double radius_m;  // no point is farther from the body's origin
  };
  static Body body_of(const Scene& scene, bool moves);
  const Body& body(uint32_t instance) const;

  double of_path(const Paths& paths, size_t row, const WorldState& state) const;
  std::vector<Stop> stops_of(const Paths& paths, size_t row, const WorldState& state) const;
  Stop stop_at(const Paths& paths, uint64_t vertex, const WorldState& state) const;
  double gap_to_body_m(const Stop& from, const Stop& to, uint32_t instance, const WorldState& state,
                       double most_m) const;

  const Scene& scene_;
  std::span<const Instance> instances_;
  std::vector<Body> bodies_;  // the scene, then the models
  double slack_m_;
};

}  // namespace wavetracer
