// SPDX-License-Identifier: Apache-2.0
// Deep chains of reflections with closed forms: parallel plates, and a room.
// Lengths are those of the lattice of images.
#include "hard/responses.hpp"

namespace wavetracer::test {
namespace {

double worst_length(const Paths& paths, std::vector<double> expected) {
  if (paths.size() != expected.size()) return std::numeric_limits<double>::infinity();
  std::sort(expected.begin(), expected.end());
  double worst_m = 0;
  for (size_t i = 0; i < expected.size(); ++i)
    worst_m = std::max(worst_m, std::abs(paths.delay_s[i] * speed_of_light - expected[i]));
  return worst_m;
}

HardCase plates(const std::string& device) {
  const double width_m = 3;
  const glm::dvec3 u{1000, 0, 0}, v{0, 0, 1000};
  const SceneFile file({{{-500, 0, -500}, u, v}, {{-500, width_m, -500}, u, v}});
  const glm::dvec3 tx{0, 0.7, 0}, rx{4, 1.9, 0.6};
  std::vector<double> expected;
  for (int k = -20; k <= 20; ++k)
    expected.push_back(glm::distance(glm::dvec3{tx.x, image(tx.y, width_m, k), tx.z}, rx));
  const Paths paths = run(config_of(file.path(), {tx}, {rx}, 50000, 20), device).paths;
  return {"parallel plates, depth 20", "two paths an order, lengths of images", worst_length(paths, expected), 1e-9,
          "m"};
}

// (2N + 1)(2N^2 + 2N + 3) / 3 paths up to order N.
HardCase room(const std::string& device) {
  constexpr int order = 8;
  const glm::dvec3 size{5.1, 4.3, 3.2}, tx{1.37, 2.21, 1.55}, rx{3.9, 3.42, 0.87};
  const SceneFile file(reference::box_walls({0, 0, 0}, size));
  std::vector<double> expected;
  for (int i = -order; i <= order; ++i)
    for (int j = -order; j <= order; ++j)
      for (int k = -order; k <= order; ++k)
        if (std::abs(i) + std::abs(j) + std::abs(k) <= order)
          expected.push_back(
              glm::distance(glm::dvec3{image(tx.x, size.x, i), image(tx.y, size.y, j), image(tx.z, size.z, k)}, rx));
  constexpr size_t count = (2 * order + 1) * (2 * order * order + 2 * order + 3) / 3;
  const Paths paths = run(config_of(file.path(), {tx}, {rx}, TraceConfig{}.rays, order), device).paths;
  HardCase out{"room, depth 8, default rays", fmt::format("{} paths, lengths of images", count),
               worst_length(paths, expected), 1e-9, "m"};
  if (paths.size() != count) out.measured = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

HardCases many_bounces(const std::string& device) { return {plates(device), room(device)}; }

}  // namespace wavetracer::test
