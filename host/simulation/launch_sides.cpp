// SPDX-License-Identifier: Apache-2.0
// Planes are tested in double within the box of their surface. A box is larger than its surface: an unneeded launch
// costs rays, but never a path.
#include "simulation/launch_sides.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "wavetracer/device/moving.h"
#include "wavetracer/device/records.h"

namespace wavetracer {
namespace {

constexpr size_t most_planes = 3;  // the most planes of a corner

double size_of(const glm::dvec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

// A step as far beside a surface as a reflected ray starts (kernels/lib/mirror.clh).
double step_beside(const glm::dvec3& p) { return 1.9e-6 * std::max(size_of(p), 0.1); }

std::vector<SceneBox> surface_boxes(const Scene& scene) {
  std::vector<SceneBox> out;
  for (const Surface& s : scene.surfaces) out.push_back({s.lower, s.upper});
  return out;
}

}  // namespace

LaunchSides::Planes::Planes(const Scene& of)
    : scene(&of), boxes(surface_boxes(of)), radius_m(glm::length(glm::max(glm::abs(of.lower), glm::abs(of.upper)))) {}

void LaunchSides::Planes::find(const glm::dvec3& p, double tolerance_m, std::vector<Plane>& found) const {
  std::vector<uint32_t> on;
  boxes.at(p, tolerance_m, [&](uint32_t i) { on.push_back(i); });
  std::ranges::sort(on);  // only the first planes count, and the result must not depend on the order of a grid
  for (const uint32_t i : on) {
    const Surface& s = scene->surfaces[i];
    const double above_m = glm::dot(s.normal, p) - s.offset_m;
    if (std::abs(above_m) <= tolerance_m) found.push_back({s.normal, above_m});
  }
}

LaunchSides::LaunchSides(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
    : instances_(instances), static_(scene), models_(models.begin(), models.end()) {}

// Equal planes are listed once: patches of the ground, walls that touch.
std::vector<LaunchSides::Plane> LaunchSides::planes_at(const Launcher& launcher, const WorldState& state, double step_m,
                                                       std::optional<Known>& known) const {
  const glm::dvec3& p = launcher.position_m;
  const double tolerance_m = std::max(WT_ON_SURFACE_M, step_m);
  if (!known || known->position_m != p) {
    known = {p, {}};
    static_.find(p, tolerance_m, known->planes);
  }
  std::vector<Plane> found = known->planes;
  for (uint32_t i = 0; i < state.instances.size(); ++i) {
    const Placement& body = state.instances[i];
    const Planes& model = models_[instances_[i].model];
    if (!body.present || launcher.source == (WT_OWN | i)) continue;
    if (glm::distance(p, body.position_m) > model.radius_m + tolerance_m) continue;
    const size_t first = found.size();
    model.find(glm::transpose(body.rotation) * (p - body.position_m), tolerance_m, found);
    for (size_t k = first; k < found.size(); ++k) found[k].normal = body.rotation * found[k].normal;
  }
  std::vector<Plane> out;
  for (const Plane& plane : found) {
    const auto same = [&](const Plane& other) { return std::abs(glm::dot(plane.normal, other.normal)) > 1 - 1e-6; };
    if (out.size() < most_planes && std::ranges::none_of(out, same)) out.push_back(plane);
  }
  return out;
}

std::vector<Launcher> LaunchSides::of(const std::vector<Launcher>& launchers, const WorldState& state) {
  std::vector<std::vector<Launcher>> sides(launchers.size());
  for (const Launcher& launcher : launchers)
    if (launcher.transmitter >= known_.size()) known_.resize(launcher.transmitter + 1);
  const auto find = [&](size_t i) {
    sides[i] = {launchers[i]};
    const double step_m = step_beside(launchers[i].position_m);
    for (const Plane& plane : planes_at(launchers[i], state, step_m, known_[launchers[i].transmitter])) {
      std::vector<Launcher> both;
      for (const Launcher& from : sides[i])
        for (const double side : {1.0, -1.0}) {
          const double beside_m = side * std::max(step_m, side * plane.above_m);
          Launcher& next = both.emplace_back(from);
          next.position_m += (beside_m - plane.above_m) * plane.normal;
        }
      sides[i] = std::move(both);
    }
  };
  // One thread does a hundred launchers before others have started.
  tbb::parallel_for(tbb::blocked_range<size_t>(0, launchers.size(), 128), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) find(i);
  });
  std::vector<Launcher> out;
  for (const std::vector<Launcher>& each : sides) out.insert(out.end(), each.begin(), each.end());
  return out;
}

}  // namespace wavetracer
