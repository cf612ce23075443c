// SPDX-License-Identifier: Apache-2.0
// The surroundings of a place in the static scene: the closed body that holds it, the ground below, the surface that it
// is on, and the triangles that a line meets. They serve warnings and explanations; rays of the simulation are traced
// elsewhere. Coordinates are recentred; the scene must outlive this.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/triangle_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// An end this near to a surface is on it (WT_ON_SURFACE_M of the kernels): whether the surface hides it is undefined.
constexpr double on_surface_m = 1e-4;

class Surroundings {
 public:
  explicit Surroundings(const Scene& scene);
  ~Surroundings();
  Surroundings(Surroundings&&) noexcept;

  using Crossing = TriangleGrid::Crossing;
  // Gives the same as TriangleGrid::crossings().
  std::vector<Crossing> crossings(const glm::dvec3& a, const glm::dvec3& b) const;

  // A body is a set of triangles that are joined by edges. It holds a place if lines from there to all sides leave it:
  // each meets it an odd number of times. So walls and a roof are closed without a floor, and a bridge or a carport is
  // not.
  struct Body {
    uint32_t number;  // number of the body
    uint32_t object;  // index into Scene::objects: the object that is met first
  };
  std::optional<Body> body_at(const glm::dvec3& p) const;
  // Does the body fill so little of the scene's box that most of the scene is outside of it?
  bool small(const Body& body) const;

  // The depth of p below everything there, if the lowest surface belongs to an object that is as wide as a ground: half
  // of the scene's box.
  struct Depth {
    double metres;
    uint32_t object;
  };
  std::optional<Depth> below_ground(const glm::dvec3& p) const;
  // Is there a surface below at half of the scene's places or more, seen from above?
  bool has_ground() const;
  // The height of p above the next surface below it, or a negative number if a surface is at most `rise_m` above it.
  std::optional<double> height_above(const glm::dvec3& p, double rise_m) const;

  // The object whose surface p is on, within on_surface_m.
  std::optional<uint32_t> object_at(const glm::dvec3& p) const;

  // The distance of p from the scene's box, seen from above; 0 inside.
  double outside_m(const glm::dvec3& p) const;

  // An object for messages: its name in the scene file, in quotes.
  std::string name_of(uint32_t object) const;
  const Scene& scene() const { return scene_; }

 private:
  struct Index;
  const Scene& scene_;
  std::unique_ptr<const Index> index_;
};

}  // namespace wavetracer
