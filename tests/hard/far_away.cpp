// SPDX-License-Identifier: Apache-2.0
// Large coordinates and long ways: a scene at UTM coordinates, paths of 14 km.
// Coordinates are multiples of 1/64 m, so that moving a scene by whole metres causes no rounding.
#include "hard/responses.hpp"

namespace wavetracer::test {
namespace {

// Makes a street corner: ground, three walls and a block, with every feature on.
Paths at(const std::string& device, const glm::dvec3& offset) {
  std::vector<Quad> walls{{{-40, -30, 0}, {80, 0, 0}, {0, 60, 0}},
                          {{-40, 12.25, 0}, {80, 0, 0}, {0, 0, 9.5}},
                          {{-40, -12.5, 0}, {30, 0, 0}, {0, 0, 8}},
                          {{30.125, -30, 0}, {0, 60, 0}, {0, 0, 7}}};
  for (const Quad& q : reference::box_walls({2, -9, 0.5}, {9.5, -3.25, 5})) walls.push_back(q);
  for (Quad& q : walls) q.corner += offset;
  const glm::dvec3 tx{-11.375, 3.28125, 2.015625}, rx[] = {{14.171875, -7.421875, 1.5}, {21.6875, 6.34375, 1.75}};
  const SceneFile file({Part{walls, "concrete"}});
  Config config = config_of(file.path(), {tx + offset}, {rx[0] + offset, rx[1] + offset}, 100000, 3);
  config.materials.emplace_back().name = "concrete";
  config.materials.back().scattering = 0.4;
  config.trace.diffraction = config.trace.transmission = config.trace.scattering = true;
  config.trace.max_diffractions = 2;
  return run(config, device).paths;
}

void add_utm(const std::string& device, HardCases& cases) {
  const Paths here = at(device, {0, 0, 0}), there = at(device, {691000, 5334000, 500});
  std::string kinds;
  for (uint32_t rx = 0; rx < 2; ++rx) kinds += kinds_between(here, 0, rx);
  const bool all = here.size() > 100 && std::ranges::all_of(std::string("RSTD"), [&](char kind) {
                     return kinds.find(kind) != std::string::npos;
                   });
  const Difference apart = all ? difference(here, there) : Difference{NAN, NAN};
  cases.push_back({"street corner at UTM 691000, 5334000", fmt::format("gains of its {} paths at 0, 0", here.size()),
                   apart.gain_db, 1e-9, "dB"});
  cases.push_back({"street corner at UTM 691000, 5334000, delays", "delays at 0, 0", apart.delay_s, 1e-15, "s"});
}

// Direct, over a ground, over it and a wall, and over the edge of a screen.
void add_long(const std::string& device, HardCases& cases) {
  const glm::dvec3 tx{-7000, 40, 30}, rx{7000, -25, 1.5};
  const Quad ground{{-7500, -500, 0}, {15000, 0, 0}, {0, 1000, 0}}, wall{{-7500, 300, 0}, {15000, 0, 0}, {0, 0, 200}};
  const auto image = [&](double y, double z) { return glm::distance(glm::dvec3{tx.x, y, z}, rx); };
  std::vector<double> lengths{glm::distance(tx, rx), image(tx.y, -tx.z), image(600 - tx.y, tx.z),
                              image(600 - tx.y, -tx.z)};
  std::sort(lengths.begin(), lengths.end());
  const SceneFile open({ground, wall});
  const Paths paths = run(config_of(open.path(), {tx}, {rx}, 50000, 2), device).paths;
  HardCase mirrored{"14 km over ground and wall", "delays of the images", std::numeric_limits<double>::infinity(),
                    1e-15, "s"};
  if (paths.size() == lengths.size()) {
    mirrored.measured = 0;
    for (size_t i = 0; i < lengths.size(); ++i)
      mirrored.measured = std::max(mirrored.measured, std::abs(paths.delay_s[i] - lengths[i] / speed_of_light));
  }
  cases.push_back(mirrored);

  const double top_m = 55;
  const SceneFile screen({{{1000, -500, 0}, {0, 1000, 0}, {0, 0, top_m}}});
  Config config = config_of(screen.path(), {tx}, {rx}, 50000, 1);
  config.trace.diffraction = true;
  const Paths bent = run(config, device).paths;
  const double before_m = std::hypot(1000 - tx.x, top_m - tx.z), behind_m = std::hypot(rx.x - 1000, top_m - rx.z);
  const double delay_s = std::hypot(before_m + behind_m, tx.y - rx.y) / speed_of_light;
  double nearest_s = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < bent.size(); ++i)
    if (kinds_of(bent, i) == "D") nearest_s = std::min(nearest_s, std::abs(bent.delay_s[i] - delay_s));
  cases.push_back({"14 km over the edge of a screen", "delay of the shortest way", nearest_s, 1e-15, "s"});
}

}  // namespace

HardCases far_away(const std::string& device) {
  HardCases cases;
  add_utm(device, cases);
  add_long(device, cases);
  return cases;
}

}  // namespace wavetracer::test
