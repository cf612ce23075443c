// SPDX-License-Identifier: Apache-2.0
// Meshes that float32 and welding find hard: slivers, walls in one plane, walls 1 mm apart, T-junctions.
// Expected numbers of paths are counted by hand, lengths are those of images.
#include "hard/responses.hpp"
#include "simulation/drive.hpp"

namespace wavetracer::test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
using Length = std::pair<std::string, double>;  // kinds of a path, its length in metres

double worst_length(const Paths& paths, uint32_t rx, const std::vector<Length>& expected) {
  const std::vector<size_t> rows = rows_between(paths, 0, rx);
  if (rows.size() != expected.size()) return never;
  double worst_m = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (kinds_of(paths, rows[i]) != expected[i].first) return never;
    worst_m = std::max(worst_m, std::abs(paths.delay_s[rows[i]] * speed_of_light - expected[i].second));
  }
  return worst_m;
}

// A wall of 10 m by 4 m in the plane y = 0, cut along z = 2 m by a band of slivers, 0.5 m wide and 10 um high. Thinner
// columns would test nothing, since vertices within 1 mm are welded.
Mesh wall_of_slivers() {
  Mesh mesh{{}, {}, "metal"};
  constexpr uint32_t columns = 40;
  for (uint32_t i = 0; i <= columns; ++i) {
    const double x = -5 + 0.25 * i;
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 0}, {x, 0, 2 + (i % 2) * 1e-5}, {x, 0, 4}});
  }
  for (uint32_t a = 0; a < 3 * columns; a += 6) {  // two columns: below the band, the sliver, above
    const uint32_t b = a + 3, c = b + 3;
    for (const auto& triangle : std::initializer_list<std::array<uint32_t, 3>>{{a, b, a + 1},
                                                                               {b, c + 1, a + 1},
                                                                               {b, c, c + 1},
                                                                               {a + 1, c + 1, b + 1},
                                                                               {a + 1, b + 1, a + 2},
                                                                               {b + 1, b + 2, a + 2},
                                                                               {b + 1, c + 1, b + 2},
                                                                               {c + 1, c + 2, b + 2}})
      mesh.triangles.push_back(triangle);
  }
  return mesh;
}

HardCase slivers(const std::string& device) {
  Points receivers;
  for (int i = 0; i < 40; ++i) receivers.push_back({-3.9 + 0.2 * i, -3, 1.5 + 2.5e-7 * i});  // mirrored in the band
  const glm::dvec3 tx{0.3, -3, 2.5};
  const Mesh mesh = wall_of_slivers();
  const MeshFile cut({mesh});
  const SceneFile whole({{{-5, 0, 0}, {10, 0, 0}, {0, 0, 4}}});
  size_t triangles = 0;
  const auto paths_of = [&](const std::filesystem::path& scene) {
    Config config = config_of(scene, {tx}, receivers, 20000, 2);
    config.trace.diffraction = true;
    config.trace.diffraction_rays = 1000;
    Simulation simulation(config, device);
    triangles = simulation.scene().triangles.size();
    return simulation.run_frame(0).paths;
  };
  const Paths expected = paths_of(whole.path()), paths = paths_of(cut.path());
  const bool meant = triangles == mesh.triangles.size() && expected.size() >= 2 * receivers.size();
  return {"wall of slivers 10 um high", "paths and gains of one quadrilateral",
          meant ? difference(paths, expected).gain_db : never, 1e-6, "dB"};
}

Paths through(const std::string& device, const SceneFile& file, uint32_t max_depth) {
  Config config = config_of(file.path(), {{-3, 0.3, 0.2}}, {{-2, -0.4, 0.7}, {4, -0.4, 0.7}}, 50000, max_depth);
  config.trace.transmission = true;
  config.trace.max_transmissions = 2;
  return run(config, device).paths;
}

// Returns the length between (-3, y, z) and an image at x, for the y and z of the links of through.
double across(double x_m) { return std::hypot(x_m, 0.7, 0.5); }

HardCase coincident_walls(const std::string& device) {
  const SceneFile file({Part{{{{0, -50, -50}, {0, 100, 0}, {0, 0, 100}}}, "concrete"},
                        Part{{{{0, -40, -45}, {0, 90, 0}, {0, 0, 80}}}, "glass"}});
  const Paths paths = through(device, file, 4);
  return {
      "coincident walls", "in front one reflection, behind one transmission",
      std::max(worst_length(paths, 0, {{"", across(1)}, {"R", across(5)}}), worst_length(paths, 1, {{"T", across(7)}})),
      1e-9, "m"};
}

// Between the walls waves go back and forth: TRT from the second wall, TRRT behind it.
HardCase near_walls(const std::string& device, double apart_m, bool equal) {
  const double more = equal ? 0 : 3;
  const SceneFile file(
      {Part{{{{0, -50, -50}, {0, 100, 0}, {0, 0, 100}}}, "concrete"},
       Part{{{{apart_m, -50 - more, -50 - more}, {0, 100 + 2 * more, 0}, {0, 0, 100 + 2 * more}}}, "glass"}});
  const Paths paths = through(device, file, 4);
  return {fmt::format("walls {} mm apart{}", 1000 * apart_m, equal ? ", corners as well" : ""),
          "LOS R TRT in front, TT TRRT behind, lengths of images",
          std::max(worst_length(paths, 0, {{"", across(1)}, {"R", across(5)}, {"TRT", across(5 + 2 * apart_m)}}),
                   worst_length(paths, 1, {{"TT", across(7)}, {"TRRT", across(7 + 2 * apart_m)}})),
          1e-9, "m"};
}

// A wall of one quadrilateral beside two whose common corner lies in the middle of its side.
void add_t_junction(const std::string& device, HardCases& cases) {
  const std::vector<Quad> parts{
      {{-5, 0, 0}, {5, 0, 0}, {0, 0, 6}}, {{0, 0, 0}, {5, 0, 0}, {0, 0, 2.7}}, {{0, 0, 2.7}, {5, 0, 0}, {0, 0, 3.3}}};
  const SceneFile file(parts), whole({{{-5, 0, 0}, {10, 0, 0}, {0, 0, 6}}});
  const glm::dvec3 tx{1, -4, 3};
  Points front, behind;
  for (int i = 0; i < 40; ++i) front.push_back({-1 - (i - 20) * 1e-3, -4, 0.6 + 0.12 * i});  // mirrored near x = 0
  for (int i = 0; i < 1000; ++i) behind.push_back({-1 + (i % 3 - 1) * 1e-7, 4, 0.4 + 5.2e-3 * i});
  const auto paths_of = [&](const std::filesystem::path& scene) {
    Config config = config_of(scene, {tx}, front, 20000, 2);
    config.trace.diffraction = true;
    config.trace.diffraction_rays = 1000;
    return run(config, device).paths;
  };
  const Paths joined = paths_of(file.path()), one = paths_of(whole.path());
  // Rims may be one wedge or several: the sum of their diffraction must be the same.
  const std::vector<Response> a = responses(joined, 0, front.size()), b = responses(one, 0, front.size());
  double worst = 0;
  for (size_t i = 0; i < front.size(); ++i)
    for (size_t k = 0; k < 4; ++k) worst = std::max(worst, std::abs(a[i][k] - b[i][k]) / friis(8));
  cases.push_back({"wall with a T-junction", "the field of one quadrilateral", worst, 1e-9, "of free space"});
  cases.push_back({"wall with a T-junction, seen through", "1,000 lines of sight across the junction, none passes",
                   static_cast<double>(run(config_of(file.path(), {tx}, behind, 1000, 1), device).paths.size()), 0,
                   "paths"});
}

}  // namespace

HardCases meshes(const std::string& device) {
  HardCases cases{slivers(device), coincident_walls(device), near_walls(device, 1e-3, false),
                  near_walls(device, 1.5e-3, true), near_walls(device, 1e-3, true)};
  add_t_junction(device, cases);
  return cases;
}

}  // namespace wavetracer::test
