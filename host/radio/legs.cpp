// The legs of one path, and how fast it gets shorter.
#include "radio/legs.hpp"

#include <glm/geometric.hpp>

#include "wavetracer/paths.hpp"

namespace wavetracer {
namespace {

// Below this the direction of a leg is rounding error of its ends, and the law of reflection says it better.
constexpr double shortest_leg_m = 1e-6;

}  // namespace

void Legs::fill(const SurfaceTable& surfaces, const WorldState& state, const PathGeometry& geometry, size_t path) {
  length_m_ = 0;
  directions_.clear();
  lengths_m_.clear();
  glm::dvec3 from = state.transmitters[geometry.tx[path]].position_m;
  const auto add = [&](const glm::dvec3& to, const glm::dvec3& continued) {
    const glm::dvec3 leg = to - from;
    const double length_m = glm::length(leg);
    length_m_ += length_m;
    lengths_m_.push_back(length_m);
    directions_.push_back(length_m > shortest_leg_m ? leg / length_m : continued);
    from = to;
  };
  glm::dvec3 continued{0};
  for (uint64_t i = geometry.first[path]; i < geometry.first[path + 1]; ++i) {
    add(geometry.vertex[i], continued);
    continued = directions_.back();
    if (geometry.interaction[i] == reflection)
      continued = glm::reflect(continued, surfaces.normal(surfaces.at(geometry.surface[i]), state));
  }
  add(state.receivers[geometry.rx[path]].position_m, continued);
}

double path_length_m(const WorldState& state, const PathGeometry& geometry, size_t path) {
  double length_m = 0;
  glm::dvec3 from = state.transmitters[geometry.tx[path]].position_m;
  for (uint64_t i = geometry.first[path]; i < geometry.first[path + 1]; ++i) {
    length_m += glm::length(geometry.vertex[i] - from);
    from = geometry.vertex[i];
  }
  return length_m + glm::length(state.receivers[geometry.rx[path]].position_m - from);
}

// L = sum |x(i+1) - x(i)| over the ends and vertices x(i), so with the legs' directions k(i)
//   dL/dt = sum k(i) . (x'(i+1) - x'(i)) = k_last . rx' - k_first . tx' + sum over vertices (k_in - k_out) . x'.
// A vertex moves with the material point v there and slides along its surface or edge besides. Where a path is
// reflected, k_in - k_out is along the normal, and where it is diffracted, normal to the edge: L is stationary under
// sliding (Fermat's principle), and x' = v serves exactly, v of a turning body included. What is scattered is a point
// of the body. What is transmitted goes straight on, k_in = k_out, and adds nothing.
double closing_speed_m_s(const Legs& legs, const WorldState& state, const PathGeometry& geometry, size_t path,
                         std::span<const uint32_t> instances) {
  const std::vector<glm::dvec3>& k = legs.directions();
  double speed = glm::dot(state.transmitters[geometry.tx[path]].velocity_m_s, k.front()) +
                 glm::dot(state.receivers[geometry.rx[path]].velocity_m_s, -k.back());
  for (size_t m = 0; m < instances.size(); ++m) {
    const uint64_t i = geometry.first[path] + m;
    if (instances[m] == no_instance || geometry.interaction[i] == transmission) continue;
    const Placement& body = state.instances[instances[m]];
    const glm::dvec3 velocity_m_s =
        body.velocity_m_s + glm::cross(body.angular_velocity_rad_s, geometry.vertex[i] - body.position_m);
    speed += glm::dot(velocity_m_s, k[m + 1] - k[m]);
  }
  return speed;
}

}  // namespace wavetracer
