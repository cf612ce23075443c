// What is around a place of the static scene: the closed body that holds it, the ground below, the surface it lies on,
// and what a line meets. For warnings and explanations; rays of the simulation are traced elsewhere.
// Assumes recentred coordinates; the scene must outlive this.
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

// An end this near to a surface lies on it (WT_ON_SURFACE_M of the kernels): whether the surface hides it is undefined.
constexpr double on_surface_m = 1e-4;

class Surroundings {
 public:
  explicit Surroundings(const Scene& scene);
  ~Surroundings();
  Surroundings(Surroundings&&) noexcept;

  using Crossing = TriangleGrid::Crossing;
  // As TriangleGrid::crossings().
  std::vector<Crossing> crossings(const glm::dvec3& a, const glm::dvec3& b) const;

  // A body is what edges join. It holds a place where lines to all sides leave it: each meets it an odd number of
  // times. So walls and a roof are closed without a floor, and a bridge or a carport is not.
  struct Body {
    uint32_t number;  // of the body
    uint32_t object;  // index into Scene::objects: what is met first
  };
  std::optional<Body> body_at(const glm::dvec3& p) const;
  // Whether the body fills so little of the scene's box that most of the scene is outside of it.
  bool small(const Body& body) const;

  // How far p lies below all that is there, if that belongs to an object as wide as a ground is: half of the scene's
  // box.
  struct Depth {
    double metres;
    uint32_t object;
  };
  std::optional<Depth> below_ground(const glm::dvec3& p) const;
  // Whether there is something below at half of the scene's places or more, seen from above.
  bool has_ground() const;
  // Height of p above the next surface below it, or, for one at most `rise_m` above it, a negative number.
  std::optional<double> height_above(const glm::dvec3& p, double rise_m) const;

  // The object whose surface p lies on, within on_surface_m.
  std::optional<uint32_t> object_at(const glm::dvec3& p) const;

  // How far p is outside of the scene's box, seen from above.
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
