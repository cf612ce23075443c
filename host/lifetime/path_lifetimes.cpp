// SPDX-License-Identifier: Apache-2.0
// The conditions under which a path stays hold for all smaller motions if they hold for one, so the largest motion is
// found by halving.
#include "lifetime/path_lifetimes.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace wavetracer {
namespace {

// Surfaces within this distance of a stop whose normals differ by no more are in one plane with its surface, and stay
// there wherever the stop moves on it. The exact test of legs asks for 1e-4 m.
constexpr double same_plane_m = 5e-5, same_normal = 5e-7;

// Returns the largest r up to most_m for which the condition holds; it holds for all smaller ones, too.
double largest(double most_m, const std::function<bool(double)>& holds) {
  if (holds(most_m)) return most_m;
  double low = 0, high = most_m;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

// Returns a distance that some two points of the scene have across any axis: the least altitude of a triangle that they
// make. Along its longest side the triangle is as wide as that, and along other directions it is wider.
double width_of(const Scene& scene) {
  if (scene.vertices.empty()) return 0;
  const auto farthest = [&](const auto& distance) { return *std::ranges::max_element(scene.vertices, {}, distance); };
  const glm::dvec3 a = farthest([&](const glm::dvec3& p) { return glm::distance(p, scene.vertices[0]); });
  const glm::dvec3 b = farthest([&](const glm::dvec3& p) { return glm::distance(p, a); });
  const glm::dvec3 way = b - a;
  const glm::dvec3 c = farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(p - a, way)); });
  const double longest = std::max({glm::length(way), glm::distance(a, c), glm::distance(b, c)});
  return longest > 0 ? glm::length(glm::cross(c - a, way)) / longest : 0;
}

bool lies_in(const Surface& surface, const Stop& stop) {
  for (const StopPlane& plane : stop.planes)
    if (glm::length(glm::cross(plane.normal, surface.normal)) <= same_normal &&
        std::abs(glm::dot(surface.normal, stop.p) - surface.offset_m) <= same_plane_m)
      return true;
  return false;
}

// The stop in the coordinates of a body.
Stop seen_from(const Placement& at, Stop stop) {
  const glm::dmat3 back = glm::transpose(at.rotation);
  stop.p = back * (stop.p - at.position_m);
  for (StopPlane& plane : stop.planes) {
    plane.offset_m -= glm::dot(plane.normal, at.position_m);
    plane.normal = back * plane.normal;
  }
  return stop;
}

StopPlane placed(const StopPlane& plane, const Placement& at) {
  const glm::dvec3 normal = at.rotation * plane.normal;
  return {normal, plane.offset_m + glm::dot(normal, at.position_m)};
}

}  // namespace

PathLifetimes::Body PathLifetimes::body_of(const Scene& scene, bool moves) {
  double radius = 0;
  for (const glm::dvec3& p : scene.vertices) radius = std::max(radius, glm::length(p));
  return {&scene, SurfaceDistance(scene), SurfaceBorders(scene), moves ? width_of(scene) : at_rest, radius};
}

PathLifetimes::PathLifetimes(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
    : scene_(scene), instances_(instances) {
  bodies_.push_back(body_of(scene, false));
  for (const Scene& model : models) bodies_.push_back(body_of(model, true));
  // The exact test of legs looks in front of surfaces for what hides them, by 0.1 mm and the rounding of float32; so
  // this is a little more.
  slack_m_ = 1e-3 + 1e-6 * bodies_[0].radius_m;
}

const PathLifetimes::Body& PathLifetimes::body(uint32_t instance) const {
  return bodies_[instance == no_instance ? 0 : 1 + instances_[instance].model];
}

Stop PathLifetimes::stop_at(const Paths& paths, uint64_t vertex, const WorldState& state) const {
  Stop out{.p = paths.vertex_position_m[vertex] - scene_.origin_m,
           .interaction = static_cast<Interaction>(paths.vertex_interaction[vertex]),
           .body = paths.vertex_instance[vertex]};
  const Body& on = body(out.body);
  out.width_m = on.width_m;
  const Placement at = out.body == no_instance ? Placement{} : state.instances[out.body];
  const glm::dvec3 own = glm::transpose(at.rotation) * (out.p - at.position_m);
  const uint32_t number = paths.vertex_surface[vertex];
  if (out.interaction == diffraction) {
    const Wedge& wedge = on.scene->wedges[number];
    const double along = glm::dot(own - wedge.start, wedge.along);
    out.margin_m = std::min(along, wedge.length_m - along);
    out.direction = at.rotation * wedge.along;
    out.surfaces = wedge.surface;
  } else {
    out.margin_m = on.borders.margin_m(number, own);
    out.direction = at.rotation * on.scene->surfaces[number].normal;
    out.surfaces = {number, number};
  }
  for (const uint32_t surface : out.surfaces)
    out.planes.push_back(placed({on.scene->surfaces[surface].normal, on.scene->surfaces[surface].offset_m}, at));
  return out;
}

std::vector<Stop> PathLifetimes::stops_of(const Paths& paths, size_t row, const WorldState& state) const {
  std::vector<Stop> out{{.p = state.transmitters[paths.tx[row]].position_m}};
  for (uint64_t vertex = paths.vertex_offset[row]; vertex < paths.vertex_offset[row + 1]; ++vertex)
    out.push_back(stop_at(paths, vertex, state));
  out.push_back({.p = state.receivers[paths.rx[row]].position_m});
  return out;
}

// The distance from a leg to the nearest surface of a body on which neither of its stops is.
double PathLifetimes::gap_to_body_m(const Stop& from, const Stop& to, uint32_t instance, const WorldState& state,
                                    double most_m) const {
  const Body& other = body(instance);
  Stop a = from, b = to;
  if (instance != no_instance) {
    const Placement& at = state.instances[instance];
    if (!at.present || distance_m(at.position_m, Segment{a.p, b.p}) - other.radius_m >= most_m) return most_m;
    a = seen_from(at, a);
    b = seen_from(at, b);
  }
  const auto holds_end = [&](uint32_t surface) {
    return std::ranges::any_of(std::array{&a, &b}, [&](const Stop* stop) {
      return stop->interaction && stop->body == instance &&
             (surface == stop->surfaces[0] || surface == stop->surfaces[1] ||
              lies_in(other.scene->surfaces[surface], *stop));
    });
  };
  return other.distance(Segment{a.p, b.p}, most_m, holds_end);
}

double PathLifetimes::of_path(const Paths& paths, size_t row, const WorldState& state) const {
  const auto kinds = std::span(paths.vertex_interaction)
                         .subspan(paths.vertex_offset[row], paths.vertex_offset[row + 1] - paths.vertex_offset[row]);
  const auto of_kind = [&](Interaction kind) { return std::ranges::count(kinds, uint8_t{kind}); };
  if (of_kind(scattering) + of_kind(target_point) > 0 || of_kind(diffraction) > 1) return 0;
  const PathMotion motion(stops_of(paths, row, state), slack_m_);
  const std::vector<Stop>& stops = motion.stops();
  for (size_t leg = 0; leg + 1 < stops.size(); ++leg)
    if (glm::distance(stops[leg].p, stops[leg + 1].p) <= slack_m_) return 0;
  double lifetime = largest(most_lifetime_m, [&](double r) { return motion.moved_m(r).has_value(); });
  // The vehicles that carry the antennas hide nothing from them.
  const uint32_t own_from = state.transmitters[paths.tx[row]].instance;
  const uint32_t own_to = state.receivers[paths.rx[row]].instance;
  for (size_t leg = 0; leg + 1 < stops.size() && lifetime > 0; ++leg) {
    const auto narrow = [&](uint32_t instance) {
      const auto needed_m = [&](double r) {
        const std::optional<std::vector<double>> moved = motion.moved_m(r);
        if (!moved) return at_rest;
        return std::max((*moved)[leg], (*moved)[leg + 1]) + slack_m_ + (instance == no_instance ? 0 : r);
      };
      const double enough_m = needed_m(lifetime);
      const double gap_m = gap_to_body_m(stops[leg], stops[leg + 1], instance, state, enough_m);
      if (gap_m < enough_m) lifetime = largest(lifetime, [&](double r) { return needed_m(r) < gap_m; });
    };
    narrow(no_instance);
    for (uint32_t instance = 0; instance < instances_.size(); ++instance)
      if (!(leg == 0 && instance == own_from) && !(leg + 2 == stops.size() && instance == own_to)) narrow(instance);
  }
  return lifetime;
}

std::vector<double> PathLifetimes::operator()(const Paths& paths, const WorldState& state) const {
  std::vector<double> out(paths.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, paths.size(), 16), [&](const tbb::blocked_range<size_t>& rows) {
    for (size_t row = rows.begin(); row < rows.end(); ++row) out[row] = of_path(paths, row, state);
  });
  return out;
}

}  // namespace wavetracer
