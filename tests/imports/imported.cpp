// SPDX-License-Identifier: Apache-2.0
// Degrees of nodes come from a spherical formula that is independent of PROJ: exact to 1e-5 over a hundred metres.
#include "imported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "scene/load.hpp"

namespace wavetracer::test {
namespace {

// The middle of the maps, with the radii of curvature of WGS84 there, so that metres are true.
constexpr double latitude = 48.137, longitude = 11.575, degree = 0.017453292519943295;
constexpr double a = 6378137, e2 = 0.00669437999014;
const double sine = std::sin(latitude * degree), w = std::sqrt(1 - e2 * sine * sine);
const double north_radius = a * (1 - e2) / (w * w * w), east_radius = a / w * std::cos(latitude * degree);

std::string tags_xml(const TagList& tags) {
  std::string out;
  for (const auto& [key, value] : tags) out += fmt::format("<tag k=\"{}\" v=\"{}\"/>", key, value);
  return out;
}

template <class Visit>
void each_triangle(const Scene& scene, const std::string& object, const Visit& visit) {
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    if (!scene.objects[scene.triangle_object[i]].starts_with(object)) continue;
    const auto& t = scene.triangles[i];
    visit(scene.vertices[t[0]] + scene.origin_m, scene.vertices[t[1]] + scene.origin_m,
          scene.vertices[t[2]] + scene.origin_m, i);
  }
}

}  // namespace

Points rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

int OsmText::way(const Points& points, const TagList& tags, bool closed) {
  std::string refs;
  const int first = next_;
  for (const auto& [x, y] : points) {
    nodes_ += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>\n", next_,
                          latitude + y / north_radius / degree, longitude + x / east_radius / degree);
    refs += fmt::format("<nd ref=\"{}\"/>", next_++);
  }
  if (closed) refs += fmt::format("<nd ref=\"{}\"/>", first);
  ways_ += fmt::format("<way id=\"{}\" version=\"1\">{}{}</way>\n", next_, refs, tags_xml(tags));
  return next_++;
}

int OsmText::tree(double x, double y, const TagList& tags) {
  nodes_ += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\">{}</node>\n", next_,
                        latitude + y / north_radius / degree, longitude + x / east_radius / degree, tags_xml(tags));
  return next_++;
}

int OsmText::relation(const std::vector<std::pair<int, std::string>>& ways, const TagList& tags) {
  std::string members;
  for (const auto& [id, role] : ways) members += fmt::format("<member type=\"way\" ref=\"{}\" role=\"{}\"/>", id, role);
  relations_ += fmt::format("<relation id=\"{}\" version=\"1\">{}<tag k=\"type\" v=\"multipolygon\"/>{}</relation>\n",
                            next_, members, tags_xml(tags));
  return next_++;
}

std::string OsmText::text(bool nodes_last) const {
  const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\">\n", tail = "</osm>\n";
  return head + (nodes_last ? relations_ + ways_ + nodes_ : nodes_ + ways_ + relations_) + tail;
}

Imported import_text(const std::string& text, const TemporaryFolder& folder, ImportOptions options) {
  static int count = 0;
  options.output = folder.path() / ("städtchen " + std::to_string(++count));
  ImportSummary summary = import_city(text, "map", options);
  return {summary, load_scene_file(summary.scene, SceneConfig{})};
}

double volume_m3(const Scene& scene, const std::string& object) {
  double sum = 0;
  each_triangle(scene, object, [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, size_t) {
    sum += glm::dot(p - scene.origin_m, glm::cross(q - scene.origin_m, r - scene.origin_m)) / 6;
  });
  return sum;
}

double roof_area_m2(const Scene& scene, const std::string& object) {
  double sum = 0;
  each_triangle(scene, object, [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, size_t) {
    sum += std::max(0.0, glm::cross(q - p, r - p).z / 2);
  });
  return sum;
}

double top_m(const Scene& scene, const std::string& object) {
  double top = -std::numeric_limits<double>::infinity();
  each_triangle(scene, object, [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, size_t) {
    top = std::max({top, p.z, q.z, r.z});
  });
  return top;
}

double bottom_m(const Scene& scene, const std::string& object) {
  double bottom = std::numeric_limits<double>::infinity();
  each_triangle(scene, object, [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, size_t) {
    bottom = std::min({bottom, p.z, q.z, r.z});
  });
  return bottom;
}

std::string material(const Scene& scene, const std::string& object) {
  std::string out;
  each_triangle(scene, object, [&](const glm::dvec3&, const glm::dvec3&, const glm::dvec3&, size_t i) {
    out = scene.materials[scene.surfaces[scene.triangle_surface[i]].material].name;
  });
  return out;
}

bool has_object(const Scene& scene, const std::string& object) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const std::string& name) { return name.starts_with(object); });
}

}  // namespace wavetracer::test
