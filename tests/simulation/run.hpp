// SPDX-License-Identifier: Apache-2.0
// Helpers of the end-to-end tests: scene files made of parallelograms, configurations in code, comparisons of paths.
// Scenes go through the loader like any other: welded, recentred, coplanar neighbours of one material merged.
#pragma once
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "reference/quads.hpp"
#include "scene/scene_files.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::test {

using reference::Quad;

constexpr double speed_of_light = 299792458.0;

struct Part {
  std::vector<Quad> quads;
  std::string material = "metal";
};

// A Mitsuba scene in a folder of its own, one mesh a part.
class SceneFile {
 public:
  explicit SceneFile(const std::vector<Part>& parts) {
    std::string xml = "<scene version=\"2.1.0\">\n";
    for (size_t i = 0; i < parts.size(); ++i) {
      folder_.write(fmt::format("part_{}.ply", i), ply(parts[i].quads));
      xml += fmt::format(
          "<bsdf type=\"itu-radio-material\" id=\"material-{0}\"><string name=\"type\" value=\"{1}\"/></bsdf>\n"
          "<shape type=\"ply\" id=\"part-{0}\"><string name=\"filename\" value=\"part_{0}.ply\"/>"
          "<ref id=\"material-{0}\" name=\"bsdf\"/></shape>\n",
          i, parts[i].material);
    }
    path_ = folder_.write("scene.xml", xml + "</scene>\n");
  }
  explicit SceneFile(const std::vector<Quad>& quads) : SceneFile({Part{quads}}) {}
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;

  // Doubles to the last bit.
  static std::string ply(const std::vector<Quad>& quads) {
    std::string out = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        4 * quads.size(), quads.size());
    for (const Quad& q : quads)
      for (const glm::dvec3& p : {q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v})
        out += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
    for (size_t i = 0; i < quads.size(); ++i)
      out += fmt::format("4 {} {} {} {}\n", 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
    return out;
  }
};

using Points = std::vector<glm::dvec3>;

// Ends with both polarizations, as the reference lists have them. Positions in file coordinates.
inline Config config_of(const std::filesystem::path& scene, const Points& transmitters, const Points& receivers,
                        std::optional<uint64_t> rays, uint32_t max_depth) {
  Config config;
  config.scene.file = scene.string();
  const auto ends = [](const Points& points, const char* name) {
    std::vector<RadioEnd> out;
    for (size_t i = 0; i < points.size(); ++i)
      out.push_back(
          {fmt::format("{}{}", name, i), {points[i].x, points[i].y, points[i].z}, "isotropic", "VH", {0, 0, 0}});
    return out;
  };
  config.transmitters = ends(transmitters, "tx");
  config.receivers = ends(receivers, "rx");
  config.trace.rays = rays;
  config.trace.max_depth = max_depth;
  return config;
}

inline FrameResult run(const Config& config) { return Simulation(config).run_frame(0); }

// Compares every number of every path, to the last bit.
inline bool identical(const Paths& a, const Paths& b) {
  return a.rx_ports == b.rx_ports && a.tx_ports == b.tx_ports && a.frame == b.frame && a.tx == b.tx && a.rx == b.rx &&
         a.depth == b.depth && a.delay_s == b.delay_s && a.gain_db == b.gain_db && a.a == b.a &&
         a.aod_theta_rad == b.aod_theta_rad && a.aod_phi_rad == b.aod_phi_rad && a.aoa_theta_rad == b.aoa_theta_rad &&
         a.aoa_phi_rad == b.aoa_phi_rad && a.doppler_hz == b.doppler_hz && a.vertex_offset == b.vertex_offset &&
         a.vertex_position_m == b.vertex_position_m && a.vertex_interaction == b.vertex_interaction &&
         a.vertex_surface == b.vertex_surface && a.vertex_instance == b.vertex_instance;
}

// The paths of one link as comparable rows: delay, coefficients, surfaces. Used for runs that number their ends
// differently.
struct Row {
  double delay_s;
  std::array<std::complex<double>, 4> a;
  std::vector<uint32_t> surfaces;
  std::vector<glm::dvec3> points;
  bool operator==(const Row&) const = default;
};

inline std::vector<Row> rows_of(const Paths& paths, uint32_t tx, uint32_t rx) {
  std::vector<Row> rows;
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths.tx[i] != tx || paths.rx[i] != rx) continue;
    Row row{paths.delay_s[i], paths.a[i], {}, {}};
    for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      row.surfaces.push_back(paths.vertex_surface[k]);
      row.points.push_back(paths.vertex_position_m[k]);
    }
    rows.push_back(row);
  }
  return rows;
}

// Pairs of paths of one link and depth whose points all agree to 1 mm.
inline size_t duplicates(const Paths& paths) {
  size_t count = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    for (size_t j = i + 1; j < paths.size(); ++j) {
      if (paths.tx[i] != paths.tx[j] || paths.rx[i] != paths.rx[j] || paths.depth[i] != paths.depth[j]) continue;
      double apart = 0;
      for (size_t k = 0; k < paths.depth[i]; ++k)
        apart = std::max(apart, glm::distance(paths.vertex_position_m[paths.vertex_offset[i] + k],
                                              paths.vertex_position_m[paths.vertex_offset[j] + k]));
      count += apart < 1e-3;
    }
  return count;
}

inline std::vector<size_t> count_by_depth(const Paths& paths, uint32_t rx, uint32_t max_depth) {
  std::vector<size_t> counts(max_depth + 1, 0);
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.rx[i] == rx) ++counts[paths.depth[i]];
  return counts;
}

// Image number k of coordinate x between mirrors at 0 and size: |k| reflections.
inline double image(double x, double size, int k) { return k % 2 == 0 ? k * size + x : (k + 1) * size - x; }

}  // namespace wavetracer::test
