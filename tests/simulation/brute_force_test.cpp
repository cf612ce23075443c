// SPDX-License-Identifier: Apache-2.0
// Compares whole frames with brute force: the sets of paths must be identical up to order 3 in scenes of up to 60
// surfaces, in both directions. Rays and beams must neither miss a sequence nor let one through that is no path.
#include <algorithm>
#include <map>
#include <tuple>

#include "folders.hpp"
#include "passes/triangles.hpp"
#include "reference/brute_force.hpp"
#include "simulation/buildings.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// tx, rx, kinds of interactions, surfaces and wedges
using Key = std::tuple<uint32_t, uint32_t, std::vector<uint8_t>, std::vector<uint32_t>>;

// The key of the path whose vertices are first to end.
Key key_of(uint32_t tx, uint32_t rx, const std::vector<uint8_t>& kinds, const std::vector<uint32_t>& surfaces,
           uint64_t first, uint64_t end) {
  const auto part = [&](const auto& values) {
    return std::vector(values.begin() + static_cast<ptrdiff_t>(first), values.begin() + static_cast<ptrdiff_t>(end));
  };
  return {tx, rx, part(kinds), part(surfaces)};
}

struct Difference {
  size_t found = 0, missed = 0, invented = 0;
  double length_error = 0, vertex_error_m = 0;  // errors of paths that are in both; that of the length is relative
};

Difference compare(const std::filesystem::path& scene_file, const Points& transmitters, const Points& receivers,
                   uint64_t rays, const reference::Limits& limits, DiscoveryWay discovery) {
  Config config = config_of(scene_file, transmitters, receivers, rays, limits.max_depth);
  config.trace.discovery = discovery;
  config.trace.transmission = limits.transmission;
  config.trace.max_transmissions = limits.max_transmissions;
  config.trace.diffraction = limits.diffraction;
  config.trace.max_diffractions = limits.max_diffractions;
  Simulation simulation(config);
  const Paths paths = simulation.run_frame(0).paths;
  const Scene& scene = simulation.scene();
  REQUIRE(scene.surfaces.size() <= 62);
  Points tx = transmitters, rx = receivers;
  for (glm::dvec3& p : tx) p -= scene.origin_m;
  for (glm::dvec3& p : rx) p -= scene.origin_m;
  const PathGeometry slow = reference::brute_force_all(scene, tx, rx, limits);

  std::map<Key, size_t> expected;
  for (size_t i = 0; i < slow.size(); ++i)
    expected[key_of(slow.tx[i], slow.rx[i], slow.interaction, slow.surface, slow.first[i], slow.first[i + 1])] = i;
  Difference out;
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto at = expected.find(key_of(paths.tx[i], paths.rx[i], paths.vertex_interaction, paths.vertex_surface,
                                         paths.vertex_offset[i], paths.vertex_offset[i + 1]));
    if (at == expected.end()) {
      ++out.invented;
      continue;
    }
    ++out.found;
    const size_t j = at->second;
    const double length = reference::path_length_m(slow, j, tx[slow.tx[j]], rx[slow.rx[j]]);
    out.length_error = std::max(out.length_error, std::abs(paths.delay_s[i] * speed_of_light / length - 1));
    for (size_t k = 0; k < paths.depth[i]; ++k)
      out.vertex_error_m =
          std::max(out.vertex_error_m, glm::distance(paths.vertex_position_m[paths.vertex_offset[i] + k],
                                                     slow.vertex[slow.first[j] + k] + scene.origin_m));
    expected.erase(at);
  }
  out.missed = expected.size();
  return out;
}

void check_identical(const std::filesystem::path& scene_file, const Points& transmitters, const Points& receivers,
                     uint64_t rays, const reference::Limits& limits, size_t at_least) {
  for (const DiscoveryWay discovery : {DiscoveryWay("rays"), DiscoveryWay("beams")}) {
    CAPTURE(discovery.text());
    const Difference d = compare(scene_file, transmitters, receivers, rays, limits, discovery);
    CHECK(d.missed == 0);
    CHECK(d.invented == 0);
    CHECK(d.found >= at_least);
    CHECK(d.length_error < 1e-9);
    CHECK(d.vertex_error_m < 1e-6);
  }
}

void check_identical(const std::filesystem::path& scene_file, const Points& transmitters, const Points& receivers,
                     uint64_t rays, uint32_t order, size_t at_least) {
  check_identical(scene_file, transmitters, receivers, rays, reference::Limits{.max_depth = order}, at_least);
}

std::vector<Quad> operator+(std::vector<Quad> a, const std::vector<Quad>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Buildings on the cells of a grid, and the ground. Streets between them are at least 4 m wide.
std::vector<Quad> town(int columns, int rows, uint32_t seed) {
  Random random(seed);
  std::vector<Quad> quads{{{-10, -10, 0}, {columns * 20.0 + 20, 0, 0}, {0, rows * 20.0 + 20, 0}}};
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      quads =
          quads + building({i * 20 + random.between(2, 5), j * 20 + random.between(2, 5), 0}, random.between(0, 0.15),
                           random.between(8, 12), random.between(8, 12), random.between(5, 15));
  return quads;
}

// Writes the quads on sloping ground, cut into cells whose corners have three decimals, as exporters write them: this
// gives hundreds of bends of a milliradian, which the loader must turn back into the original planes.
class RoundedFile {
 public:
  RoundedFile(const std::vector<Quad>& quads, double cell_m) {
    std::string vertices, faces;
    size_t count = 0, face_count = 0;
    for (const Quad& q : quads) {
      const int n = static_cast<int>(std::ceil(glm::length(q.u) / cell_m)),
                m = static_cast<int>(std::ceil(glm::length(q.v) / cell_m));
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) {
          const glm::dvec3 p = q.corner + q.u * (i / double(n)) + q.v * (j / double(m));
          vertices += fmt::format("{:.3f} {:.3f} {:.3f}\n", p.x, p.y, p.z + 0.0213 * p.x + 0.0147 * p.y);
        }
      }
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j, face_count += 2) {
          const size_t a = count + static_cast<size_t>(i * (m + 1) + j), b = a + static_cast<size_t>(m) + 1;
          faces += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
        }
      }
      count += static_cast<size_t>((n + 1) * (m + 1));
    }
    folder_.write("cells.ply", fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\n"
                                           "property double y\nproperty double z\nelement face {}\n"
                                           "property list uchar int vertex_indices\nend_header\n",
                                           count, face_count) +
                                   vertices + faces);
    path_ = folder_.write("scene.xml",
                          "<scene version=\"2.1.0\"><bsdf type=\"itu-radio-material\" id=\"m\"><string name=\"type\" "
                          "value=\"concrete\"/></bsdf><shape type=\"ply\" id=\"cells\"><string name=\"filename\" "
                          "value=\"cells.ply\"/><ref id=\"m\" name=\"bsdf\"/></shape></scene>");
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;
};

const std::filesystem::path scenes = std::filesystem::path(test::source_folder()) / "tests/reference/scenes";

}  // namespace

TEST_CASE("a room with furniture, order 3") {
  const std::vector<Quad> room = reference::box_walls({0, 0, 0}, {7, 5, 2.8}) +
                                 building({1.2, 1.1, 0.001}, 0.3, 1.6, 0.8, 0.75) +
                                 building({4.9, 3.1, 0.001}, -0.2, 0.6, 1.2, 1.9);
  const SceneFile file(room);
  check_identical(file.path(), {{0.613, 4.227, 1.741}, {6.359, 0.773, 2.117}},
                  {{3.331, 2.629, 1.137}, {5.923, 4.619, 0.643}, {0.541, 0.431, 2.407}}, 400000, 3, 200);
}

TEST_CASE("corners and wedges, order 3") {
  const SceneFile corner(
      {{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 0, 0}, {9, 0, 0}, {0, 0, 9}}, {{0, 0, 0}, {0, 9, 0}, {0, 0, 9}}});
  check_identical(corner.path(), {{3.1, 4.2, 2.3}}, {{5.7, 1.9, 3.8}, {1.1, 1.3, 6.9}}, 100000, 3, 16);
  // Two mirrors at 50 degrees over a ground.
  const SceneFile wedge({{{0, 0, 0}, {12, 0, 0}, {0, 0, 8}},
                         {{0, 0, 0}, {12 * std::cos(0.873), 12 * std::sin(0.873), 0}, {0, 0, 8}},
                         {{-5, -5, 0}, {20, 0, 0}, {0, 20, 0}}});
  check_identical(wedge.path(), {{5.1, 1.9, 2.3}}, {{4.3, 3.1, 1.4}, {7.7, 4.4, 3.2}}, 100000, 3, 14);
}

TEST_CASE("echoes from corners: those that open towards the antenna, none of a house") {
  // A house, and a corner of two walls, on a ground. Every echo by two or three surfaces comes from one point.
  std::vector<Quad> quads = building({3, 2, 0}, 0, 4, 5, 6);
  quads.insert(quads.end(), {{{-20, -20, 0}, {40, 0, 0}, {0, 40, 0}},
                             {{-6, -6, 0}, {14, 0, 0}, {0, 0, 5}},
                             {{-6, -6, 0}, {0, 14, 0}, {0, 0, 5}}});
  const SceneFile file(quads);
  const Points ends{{-1.3, -0.7, 1.9}, {4.1, -3.3, 1.2}, {0.6, 3.9, 7.1}};
  check_identical(file.path(), ends, ends, 200000, 3, 60);
}

TEST_CASE("a box with a screen, three reflectors: scenes of the reference lists, order 3") {
  check_identical(scenes / "box_one_screen/box_one_screen.xml", {{2.11, 1.07, 1.92}},
                  {{-2.87, -1.53, 2.41}, {3.05, -2.22, 0.83}}, 400000, 3, 20);
  check_identical(scenes / "triple_reflector/triple_reflector.xml", {{0.31, 0.17, 1.03}}, {{1.13, -0.41, 1.67}}, 400000,
                  3, 1);
}

TEST_CASE("towns of up to 11 buildings, order 3") {
  // The towns have 31, 46 and 56 surfaces. One antenna is in a street, one above the roofs; receivers are anywhere,
  // also inside buildings.
  const std::tuple<int, int, uint32_t> towns[] = {{2, 3, 1}, {3, 3, 2}, {11, 1, 3}};
  for (const auto& [columns, rows, seed] : towns) {
    CAPTURE(seed);
    const SceneFile file(town(columns, rows, seed));
    const double x = columns * 20.0, y = rows * 20.0;
    Random random(seed + 10);
    Points receivers;
    for (int i = 0; i < 12; ++i)
      receivers.push_back({random.between(-8, x + 8), random.between(-8, y + 8), random.between(1, 17)});
    check_identical(file.path(), {{0.4, 0.7 * y, 4.3}, {0.55 * x, -1.3, 18.1}}, receivers, 1000000, 3, 30);
  }
}

TEST_CASE("a town of rounded cells, order 3: its walls are surfaces") {
  for (const uint32_t seed : {4u, 8u}) {
    CAPTURE(seed);
    const std::vector<Quad> quads = town(2, 2, seed);
    const RoundedFile file(quads, 3);
    const Simulation simulation(config_of(file.path(), {{0.4, 14.1, 4.3}}, {{1, 2, 3}}, 1000, 1));
    CHECK(simulation.scene().surfaces.size() == quads.size());  // the scene has 1,200 triangles
    Random random(seed + 10);
    Points receivers;
    for (int i = 0; i < 12; ++i)
      receivers.push_back({random.between(-8, 48), random.between(-8, 48), random.between(2, 17)});
    check_identical(file.path(), {{0.4, 14.1, 4.3}, {21.3, -1.3, 18.1}}, receivers, 1000000, 3, 30);
  }
}

TEST_CASE("loose panels in every direction, order 3") {
  for (const uint32_t seed : {5u, 6u}) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<Quad> quads;
    while (quads.size() < 14) {
      const Quad quad{random.in_cube(8), 5.0 * random.direction(), 5.0 * random.direction()};
      if (glm::length(glm::cross(quad.u, quad.v)) > 15) quads.push_back(quad);
    }
    const SceneFile file(quads);
    Points receivers;
    for (int i = 0; i < 12; ++i) receivers.push_back(random.in_cube(8));
    check_identical(file.path(), {random.in_cube(8), random.in_cube(8)}, receivers, 1000000, 3, 12);
  }
}

namespace {

// Closed houses side by side, wall to wall, on a ground. Heights differ or not.
std::vector<Quad> terrace(const std::vector<double>& heights) {
  std::vector<Quad> quads{{{-40, -40, 0}, {100, 0, 0}, {0, 90, 0}}};
  for (size_t i = 0; i < heights.size(); ++i) {
    const double x = 7.25 * static_cast<double>(i);
    quads = quads + reference::box_walls({x, 0, 0}, {x + 7.25, 9.5, heights[i]});
  }
  return quads;
}

// Adds to every face the same face starting at another corner, so that its diagonal differs, and, with `middles`, a
// part from its middle.
std::vector<Quad> doubled(const std::vector<Quad>& quads, bool middles) {
  std::vector<Quad> out = quads;
  for (const Quad& q : quads) {
    out.push_back({q.corner + q.u, q.v, -q.u});
    if (middles) out.push_back({q.corner + 0.25 * q.u + 0.375 * q.v, 0.5 * q.u, 0.25 * q.v});
  }
  return out;
}

const Points before_terrace{{3.1, -12.3, 1.7}, {14.7, -8.9, 14.2}};
const Points behind_terrace{{5.3, 21.9, 1.5}, {12.9, 17.7, 2.3}, {17.1, 31.3, 1.1}, {-6.3, 4.1, 2.9}, {9.9, 4.7, 3.1}};

}  // namespace

TEST_CASE("houses that touch, wall to wall: reflections of order 3, and up to two edges") {
  for (const std::vector<double>& heights : {std::vector<double>{8, 8, 8}, {8, 10.5, 8}}) {
    CAPTURE(heights[1]);
    const SceneFile file({Part{terrace(heights), "concrete"}});
    check_identical(file.path(), before_terrace, behind_terrace, 400000, 3, 3);
    check_identical(file.path(), before_terrace, behind_terrace, 400000,
                    {.max_depth = 2, .diffraction = true, .max_diffractions = 2}, 30);
    check_identical(file.path(), before_terrace, behind_terrace, 400000,
                    {.max_depth = 3, .transmission = true, .max_transmissions = 2}, 12);
  }
}

TEST_CASE("faces that are there twice, with another diagonal or in part, are one") {
  for (const bool middles : {false, true}) {
    CAPTURE(middles);
    const SceneFile houses({Part{doubled(terrace({8, 10.5}), middles), "concrete"}});
    check_identical(houses.path(), before_terrace, behind_terrace, 400000, 2, 4);
    check_identical(houses.path(), before_terrace, behind_terrace, 400000,
                    {.max_depth = 2, .transmission = true, .max_transmissions = 2}, 8);
    if (!middles)
      check_identical(houses.path(), before_terrace, behind_terrace, 400000,
                      {.max_depth = 2, .diffraction = true, .max_diffractions = 2}, 40);
  }
}
