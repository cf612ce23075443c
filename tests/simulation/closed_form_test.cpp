// SPDX-License-Identifier: Apache-2.0
// Compares whole frames with closed forms: the image lattice of a box, parallel walls, the two-ray ground.
// Meshes are exact, so lengths must be exact as well: to 1e-9 of themselves.
#include <algorithm>
#include <utility>

#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Lengths of a link's paths, sorted.
std::vector<double> lengths(const Paths& paths, uint32_t rx) {
  std::vector<double> out;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.rx[i] == rx) out.push_back(paths.delay_s[i] * speed_of_light);
  std::sort(out.begin(), out.end());
  return out;
}

void check_lengths(const std::vector<double>& actual, std::vector<double> expected) {
  std::sort(expected.begin(), expected.end());
  REQUIRE(actual.size() == expected.size());
  double worst = 0;
  for (size_t i = 0; i < actual.size(); ++i) worst = std::max(worst, std::abs(actual[i] / expected[i] - 1));
  CHECK(worst < 1e-9);
}

std::vector<double> lattice_lengths(const glm::dvec3& size, const glm::dvec3& tx, const glm::dvec3& rx, int order) {
  std::vector<double> out;
  for (int i = -order; i <= order; ++i)
    for (int j = -order; j <= order; ++j)
      for (int k = -order; k <= order; ++k)
        if (std::abs(i) + std::abs(j) + std::abs(k) <= order)
          out.push_back(
              glm::distance(glm::dvec3(image(tx.x, size.x, i), image(tx.y, size.y, j), image(tx.z, size.z, k)), rx));
  return out;
}

void check_box(const glm::dvec3& corner, double scale = 1) {
  const glm::dvec3 size = scale * glm::dvec3{8, 5, 3}, tx = scale * glm::dvec3{1.37, 2.21, 1.55};
  Points inside{{6.13, 3.42, 0.87}, {2.9, 0.61, 2.6}, {7.71, 1.13, 1.42}};
  for (glm::dvec3& p : inside) p *= scale;
  const SceneFile file(reference::box_walls(corner, corner + size));
  Points receivers = inside;
  for (glm::dvec3& p : receivers) p += corner;
  Config config = config_of(file.path(), {tx + corner}, receivers, 1000000, 5);
  config.trace.directions = "hilbert";
  const FrameResult frame = run(config);
  CHECK(frame.counts.paths == 231 * inside.size());
  CHECK(frame.counts.rays == 1000000);
  CHECK(frame.segments_per_depth == std::vector<uint64_t>(5, 1000000));  // nothing leaves a closed box
  for (uint32_t rx = 0; rx < inside.size(); ++rx) {
    CAPTURE(rx);
    CHECK(count_by_depth(frame.paths, rx, 5) == std::vector<size_t>{1, 6, 18, 38, 66, 102});  // 4 n^2 + 2
    check_lengths(lengths(frame.paths, rx), lattice_lengths(size, tx, inside[rx], 5));
  }
  CHECK(duplicates(frame.paths) == 0);
}

// Beams find all of the lattice at every depth, from points anywhere in the box.
void check_box_by_beams(const glm::dvec3& corner, const glm::dvec3& size, const glm::dvec3& tx, const Points& inside,
                        int depth) {
  const SceneFile file(reference::box_walls(corner, corner + size));
  Points receivers = inside;
  for (glm::dvec3& p : receivers) p += corner;
  Config config = config_of(file.path(), {tx + corner}, receivers, 1000, static_cast<uint32_t>(depth));
  config.trace.discovery = "beams";
  const FrameResult frame = run(config);
  CHECK(frame.counts.rays == 0);
  CHECK(frame.missed.frames == 0);
  CHECK(frame.certificate.frames == 1);
  CHECK(frame.certificate.depth == static_cast<uint32_t>(depth));
  CHECK_FALSE(frame.certificate.any_depth);
  CHECK(frame.certificate.ends == 1);
  CHECK(frame.certificate.left_out_share() < 1e-9);
  for (uint32_t rx = 0; rx < inside.size(); ++rx) {
    CAPTURE(rx);
    check_lengths(lengths(frame.paths, rx), lattice_lengths(size, tx, inside[rx], depth));
  }
  CHECK(duplicates(frame.paths) == 0);
}

}  // namespace

TEST_CASE("a box to depth 5: 231 paths per receiver, as long as their images are far") { check_box({0, 0, 0}); }

TEST_CASE("beams find all images of a box to depth 8") {
  const glm::dvec3 size{8, 5, 3};
  check_box_by_beams({0, 0, 0}, size, {1.37, 2.21, 1.55}, {{6.13, 3.42, 0.87}, {2.9, 0.61, 2.6}}, 8);
  check_box_by_beams({691000, 5335000, 500}, size, {1.37, 2.21, 1.55}, {{6.13, 3.42, 0.87}}, 5);
  check_box_by_beams({0, 0, 0}, 1.2e4 * size, 1.2e4 * glm::dvec3{1.37, 2.21, 1.55}, {{6.13e4, 3.42e4, 0.87e4}}, 5);
  // Ends near the middle of the box, a millimetre off a wall, and in a corner.
  check_box_by_beams({0, 0, 0}, size, {4, 2.5, 1.5}, {{4.001, 2.51, 1.52}}, 5);
  check_box_by_beams({0, 0, 0}, size, {0.001, 2.21, 1.55}, {{7.999, 3.42, 0.87}, {0.002, 0.003, 0.004}}, 5);
}

TEST_CASE("the same box in UTM coordinates") { check_box({691000, 5335000, 500}); }

TEST_CASE("the same box as small and as large as scenes may be") {
  check_box({0, 0, 0}, 0.1001 / 8);
  check_box({0, 0, 0}, 9.99e5 / 8);
}

// A screen in the middle of a box hides what is behind it, whatever the size: as many rays are found and hidden as at
// 10 m.
TEST_CASE("a screen between two ends in boxes from 0.1 m to 100 km hides the same paths") {
  const auto kinds = [](double scale) {
    std::vector<Quad> quads = reference::box_walls({0, 0, 0}, scale * glm::dvec3{10, 8, 5});
    quads.push_back({scale * glm::dvec3{5, 1, 0.5}, scale * glm::dvec3{0, 5, 0}, scale * glm::dvec3{0, 0, 3}});
    const SceneFile file(quads);
    return count_by_depth(
        run(config_of(file.path(), {scale * glm::dvec3{1.3, 2.2, 1.6}}, {scale * glm::dvec3{8.1, 3.7, 2.3}}, 300000, 3))
            .paths,
        0, 3);
  };
  const std::vector<size_t> expected = kinds(1);
  CHECK(expected[0] == 0);
  CHECK(expected[1] < 6);
  for (const double scale : {0.01001, 0.02, 100.0, 1e4}) {
    CAPTURE(scale);
    CHECK(kinds(scale) == expected);
  }
}

TEST_CASE("a box with ends that mirror each other: paths through edges and corners are there once") {
  const glm::dvec3 size{5, 4, 3};
  const SceneFile file(reference::box_walls({0, 0, 0}, size));
  const std::pair<glm::dvec3, glm::dvec3> links[] = {{{1, 1, 1}, {4, 3, 2}},
                                                     {{1, 1, 1}, {4, 3, 1}},
                                                     {{1.1, 0.7, 1.3}, {3.9, 3.1, 0.9}},
                                                     {{1, 1, 1.5}, {4, 3, 1.5}},
                                                     {{2.5, 2, 1.5}, {1, 1, 1}}};
  for (const auto& [tx, rx] : links) {
    CAPTURE(tx.x);
    CAPTURE(rx.z);
    const Paths paths = run(config_of(file.path(), {tx}, {rx}, 1000000, 5)).paths;
    CHECK(count_by_depth(paths, 0, 5) == std::vector<size_t>{1, 6, 18, 38, 66, 102});
    check_lengths(lengths(paths, 0), lattice_lengths(size, tx, rx, 5));
    // A receiver beside that place has the same paths: two reflections at one point equal those of two points close by.
    // (On metal. At dielectric walls the polarization depends on which of them comes first, and the order changes at
    // this place.)
    const Paths beside = run(config_of(file.path(), {tx}, {rx + glm::dvec3(1e-5, 2e-5, -3e-5)}, 1000000, 5)).paths;
    std::vector<double> gains[] = {paths.gain_db, beside.gain_db};
    for (std::vector<double>& g : gains) std::sort(g.begin(), g.end());
    REQUIRE(gains[0].size() == gains[1].size());
    double worst = 0;
    for (size_t i = 0; i < gains[0].size(); ++i) worst = std::max(worst, std::abs(gains[0][i] - gains[1][i]));
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("a corridor: two paths an order; a canyon with a ground: three, then four") {
  const double width = 12;
  const Quad left{{-2000, 0, -1}, {4000, 0, 0}, {0, 0, 401}}, right{{-2000, width, -1}, {4000, 0, 0}, {0, 0, 401}};
  const Quad ground{{-2000, -1, 0}, {4000, 0, 0}, {0, width + 2, 0}};
  const glm::dvec3 tx{-10, 3.7, 4.1}, rx{25, 8.3, 1.6};
  std::vector<double> corridor, canyon;
  for (int k = -5; k <= 5; ++k) {
    corridor.push_back(glm::distance(glm::dvec3(tx.x, image(tx.y, width, k), tx.z), rx));
    canyon.push_back(corridor.back());
    if (std::abs(k) < 5) canyon.push_back(glm::distance(glm::dvec3(tx.x, image(tx.y, width, k), -tx.z), rx));
  }
  const SceneFile two({left, right}), three({left, right, ground});
  const FrameResult between = run(config_of(two.path(), {tx}, {rx}, 300000, 5));
  CHECK(count_by_depth(between.paths, 0, 5) == std::vector<size_t>{1, 2, 2, 2, 2, 2});
  check_lengths(lengths(between.paths, 0), corridor);
  const FrameResult street = run(config_of(three.path(), {tx}, {rx}, 300000, 5));
  CHECK(count_by_depth(street.paths, 0, 5) == std::vector<size_t>{1, 3, 4, 4, 4, 4});
  check_lengths(lengths(street.paths, 0), canyon);
}

TEST_CASE("two-ray ground of 14 km: lengths and the reflection point") {
  const SceneFile file({{{-7000, -7000, 0}, {14000, 0, 0}, {0, 14000, 0}}});
  const glm::dvec3 tx{-6000, 40, 30}, rx{6000, -25, 1.5};
  const FrameResult frame = run(config_of(file.path(), {tx}, {rx}, 200000, 3));
  REQUIRE(frame.paths.size() == 2);
  check_lengths(lengths(frame.paths, 0), {glm::distance(tx, rx), glm::distance(glm::dvec3(tx.x, tx.y, -tx.z), rx)});
  CHECK(glm::distance(frame.paths.vertex_position_m[0],
                      tx + (rx - tx) * (30 / 31.5) - glm::dvec3(0, 0, tx.z + (rx.z - tx.z) * (30 / 31.5))) < 1e-6);
}
