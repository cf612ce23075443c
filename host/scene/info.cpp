// SPDX-License-Identifier: Apache-2.0
// The report of `wavetracer scene info`.
// Positions are in file coordinates, as users know them; counts are those after cleaning.
#include "scene/info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "base/digits.hpp"
#include "scene/scene_warnings.hpp"
#include "scene/volume_overlaps.hpp"

namespace wavetracer {
namespace {

struct MaterialUse {
  uint64_t triangles = 0, surfaces = 0;
  double area_m2 = 0;
};

std::vector<MaterialUse> material_use(const Scene& scene) {
  std::vector<MaterialUse> use(scene.materials.size());
  for (const Surface& surface : scene.surfaces) {
    use[surface.material].triangles += surface.triangle_count;
    ++use[surface.material].surfaces;
  }
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    const glm::dvec3 u = scene.vertices[b] - scene.vertices[a], v = scene.vertices[c] - scene.vertices[a];
    const double x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
    use[scene.surfaces[scene.triangle_surface[t]].material].area_m2 += std::sqrt(x * x + y * y + z * z) / 2;
  }
  return use;
}

std::string electrical(const Material& m) {
  if (m.b == 0 && m.d == 0) return fmt::format("permittivity {}, conductivity {} S/m", m.a, m.c);
  return fmt::format("permittivity {} f^{}, conductivity {} f^{} S/m (f in GHz)", m.a, m.b, m.c, m.d);
}

std::string thickness(const Material& m) {
  return std::isinf(m.thickness_m) ? "half space" : fmt::format("{} m thick", m.thickness_m);
}

std::string range(const Material& m) {
  return std::isinf(m.max_ghz) ? std::string("any frequency") : fmt::format("{} to {} GHz", m.min_ghz, m.max_ghz);
}

bool is_corner(const Wedge& wedge) { return wedge.exterior_rad < std::numbers::pi; }
bool is_free(const Wedge& wedge) { return wedge.surface[0] == wedge.surface[1]; }

// Prints a point without the sign of a zero.
std::string point(glm::dvec3 p) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(p[axis]) < 5e-4) p[axis] = 0;
  return fmt::format("{:>12.3f} {:>12.3f} {:>9.3f}", p.x, p.y, p.z);
}

// Adds how far vertices were moved, and the warnings.
std::string describe_flattening(const LoadReport& report) {
  std::string out = fmt::format(
      "flattened  {} vertices moved onto the planes of their surfaces, by {:.2g} mm at most{}\n",
      report.flattened_vertices, report.flattened_by_m * 1000,
      report.plane_tolerance_m > 0 ? fmt::format(" (up to {:.2g} mm are allowed)", report.plane_tolerance_m * 1000)
                                   : " (scene.plane_tolerance_m is 0)");
  if (report.bent_triangles > 0)
    out += fmt::format(
        "           {} triangles stay as they are, because a corner is farther than that from where its planes meet\n",
        report.bent_triangles);
  for (const std::string& warning : report.warnings) out += fmt::format("warning    {}\n", warning);
  return out;
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  std::string out = fmt::format("scene      {}\n", scene.file);
  const glm::dvec3 low = scene.lower + scene.origin_m, high = scene.upper + scene.origin_m, size = high - low;
  out += fmt::format(
      "extent     x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} m ({:.1f} x {:.1f} x {:.1f})\n", low.x,
      high.x, low.y, high.y, low.z, high.z, size.x, size.y, size.z);
  out += fmt::format("origin     {:.0f}, {:.0f}, {:.0f} (coordinates are held relative to it)\n", scene.origin_m.x,
                     scene.origin_m.y, scene.origin_m.z);
  out += fmt::format("objects    {}\n", grouped(scene.objects.size()));
  out +=
      fmt::format("triangles  {} with {} vertices\n", grouped(scene.triangles.size()), grouped(scene.vertices.size()));
  uint32_t largest = 0;
  for (const Surface& s : scene.surfaces) largest = std::max(largest, s.triangle_count);
  out += fmt::format("surfaces   {}, the largest of {} triangles\n", grouped(scene.surfaces.size()), grouped(largest));
  const LoadReport& report = scene.report;
  const auto flat = std::count_if(scene.edges.begin(), scene.edges.end(), [](const Edge& e) { return e.flat; });
  out += fmt::format(
      "edges      {}: {} with two faces, {} free, {} with more than two; {} flat\n", grouped(scene.edges.size()),
      grouped(scene.edges.size() - report.free_edges - report.nonmanifold_edges), grouped(report.free_edges),
      grouped(report.nonmanifold_edges), grouped(static_cast<uint64_t>(flat)));
  const auto free = std::count_if(scene.wedges.begin(), scene.wedges.end(), is_free);
  const auto corners = std::ranges::count_if(scene.wedges, is_corner);
  out += fmt::format("diffract   {} edges: {} wedges, {} free{}\n", grouped(scene.wedges.size()),
                     grouped(scene.wedges.size() - static_cast<size_t>(free + corners)),
                     grouped(static_cast<uint64_t>(free)),
                     corners > 0 ? fmt::format(", {} corners", grouped(static_cast<uint64_t>(corners))) : "");
  out += fmt::format(
      "           left out: {} pieces flat with another mesh, {} in corners of right angles (feet of walls), {} "
      "edges at the rim of the ground\n",
      grouped(report.flat_pieces), grouped(report.corner_pieces), grouped(report.ground_rims));
  out += fmt::format("materials  {}\n", scene.materials.size());
  const std::vector<MaterialUse> use = material_use(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    if (m.vegetation) {
      const auto volumes = std::ranges::count(scene.volumes, static_cast<uint32_t>(i), &Volume::material);
      out += fmt::format("  {:<20} vegetation; {} volumes\n", m.name, volumes);
      continue;
    }
    const std::string law = m.layers.empty() ? fmt::format("{}, {}, {}", thickness(m), electrical(m), range(m))
                                             : fmt::format("{} layers", m.layers.size());
    out += fmt::format("  {:<20} {}; {} triangles, {} surfaces, {:.0f} m2\n", m.name, law, grouped(use[i].triangles),
                       grouped(use[i].surfaces), use[i].area_m2);
    for (const Material& layer : m.layers)
      out += fmt::format("    {:<18} {}, {}, {}\n", layer.name, thickness(layer), electrical(layer), range(layer));
  }
  out += fmt::format("dropped    {} degenerate and {} duplicate triangles; {} vertices welded into others\n",
                     report.degenerate_triangles, report.duplicate_triangles, report.welded_vertices);
  if (report.covered_m2 > 0)
    out += fmt::format("covered    {} of surfaces, where a smaller one of another material lies in their plane\n",
                       area_words(report.covered_m2));
  if (!scene.volumes.empty()) {
    const auto earlier = earlier_volumes(scene.volumes);
    out += fmt::format("vegetation {} volumes, {} of which may overlap earlier ones: what volumes share counts once\n",
                       scene.volumes.size(),
                       std::ranges::count_if(earlier, [](const auto& list) { return !list.empty(); }));
  }
  return out + describe_flattening(report);
}

std::string describe_edges(const Scene& scene) {
  std::string out =
      fmt::format("{:>7} {:>12} {:>12} {:>9} {:>12} {:>12} {:>9} {:>9} {:>11}  {}\n", "edge", "start x, m", "y", "z",
                  "end x, m", "y", "z", "length, m", "inside, deg", "surfaces (one: a free edge)");
  const auto surface = [&scene](uint32_t s) {
    return fmt::format("{} {}", s, scene.materials[scene.surfaces[s].material].name);
  };
  for (size_t i = 0; i < scene.wedges.size(); ++i) {
    const Wedge& w = scene.wedges[i];
    const glm::dvec3 start = scene.origin_m + w.start, end = start + w.along * w.length_m;
    out += fmt::format("{:>7} {} {} {:>9.3f} {:>11.2f}  {}", i, point(start), point(end), w.length_m,
                       360 - glm::degrees(w.exterior_rad), surface(w.surface[0]));
    if (!is_free(w)) out += ", " + surface(w.surface[1]);
    out += '\n';
  }
  return out;
}

}  // namespace wavetracer
