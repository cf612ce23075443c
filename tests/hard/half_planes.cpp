// SPDX-License-Identifier: Apache-2.0
// Half planes: knife edges against the exact Fresnel integral, and needle wedges, which become one as their angle goes
// to zero. Other edges of the screen are so far away that their diffraction is below the tolerance.
#include <glm/trigonometric.hpp>

#include "hard/responses.hpp"
#include "radio/fresnel.hpp"

namespace wavetracer::test {
namespace {

Config diffracting(const SceneFile& file, const Points& transmitters, const Points& receivers) {
  Config config = config_of(file.path(), transmitters, receivers, 20000, 1);
  config.trace.diffraction = true;
  config.trace.diffraction_rays = 1000;
  return config;
}

// A metal screen across the way, with its upper edge at top_m. Soft and hard in equal parts are the terms of the
// incident wave alone, the black screen of knife-edge theory, for which the Fresnel integral is exact.
HardCase knife_edge(const std::string& device, double top_m, double before_m, double behind_m,
                    double hz = frequency_hz) {
  const double wave_m = speed_of_light / hz;
  const double far_m = 10000;
  const SceneFile file({{{0, -far_m, top_m - far_m}, {0, 2 * far_m, 0}, {0, 0, far_m}}});
  const glm::dvec3 tx{-before_m, 0, 10};
  const double line_m = tx.z + (top_m - tx.z) * (before_m + behind_m) / before_m;  // the shadow boundary behind
  const double unit_m = std::sqrt(wave_m * behind_m * (before_m + behind_m) / (2 * before_m));  // one nu there
  Points receivers;
  for (double nu = -3; nu < 5.1; nu += 0.25) receivers.push_back({behind_m, 0, line_m - nu * unit_m});
  Config config = diffracting(file, {tx}, receivers);
  config.radio.frequency_hz = hz;
  config.scene.extrapolate_materials = true;  // ITU-R knows metal and concrete from 1 GHz on
  const std::vector<Response> h = responses_at(hz, run(config, device).paths, 0, receivers.size());
  HardCase out{
      fmt::format("knife edge at {} m, {} m before and {} m behind, {} GHz", top_m, before_m, behind_m, hz / 1e9),
      "loss of the exact Fresnel integral, nu from -3 to 5", 0, 0.05, "dB"};
  for (size_t i = 0; i < receivers.size(); ++i) {
    const glm::dvec3 rx = receivers[i];
    const double direct_m = glm::distance(tx, rx);
    const double height_m = top_m - tx.z - (rx.z - tx.z) * before_m / (before_m + behind_m);
    const double excess_m = std::hypot(before_m, top_m - tx.z) + std::hypot(behind_m, top_m - rx.z) - direct_m;
    const double nu = std::copysign(2 * std::sqrt(std::max(excess_m, 0.0) / wave_m), height_m);
    const double exact = std::abs(fresnel_tail(nu * std::sqrt(pi / 2))) / std::sqrt(pi);
    // phi of arrival is that of departure reversed.
    const double found = std::abs(h[i][0] - h[i][3]) / 2 / friis(direct_m, hz);
    out.measured = std::max(out.measured, std::abs(decibels(found / exact)));
  }
  return out;
}

// The fields behind a wedge whose faces are 400 m wide, in its shadow and in its light.
std::vector<Response> around_needle(const std::string& device, double interior_deg) {
  const double angle = glm::radians(interior_deg);
  std::vector<Quad> faces{{{0, 0, -200}, {400, 0, 0}, {0, 0, 400}}};
  if (angle > 0) faces.push_back({{0, 0, -200}, {400 * std::cos(angle), -400 * std::sin(angle), 0}, {0, 0, 400}});
  Points receivers;
  for (const double azimuth_deg : {20, 80, 110, 150, 200, 250, 290, 330})
    receivers.push_back({6 * std::cos(glm::radians(azimuth_deg)), 6 * std::sin(glm::radians(azimuth_deg)), 1});
  const Paths paths =
      run(diffracting(SceneFile(faces), {{8 * std::cos(1.0), 8 * std::sin(1.0), -0.5}}, receivers), device).paths;
  return responses(paths, 0, receivers.size(), 100);  // without the diffraction of the far rims
}

// The largest difference of two fields, over that of free space at 14 m.
double apart(const std::vector<Response>& a, const std::vector<Response>& b) {
  double worst = 0;
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t k = 0; k < 4; ++k) worst = std::max(worst, std::abs(a[i][k] - b[i][k]) / friis(14));
  return worst;
}

}  // namespace

HardCases half_planes(const std::string& device) {
  HardCases cases;
  for (const double top_m : {2.0, 10.0, 14.0}) cases.push_back(knife_edge(device, top_m, 500, 500));
  cases.push_back(knife_edge(device, 12, 300, 2000));
  for (const double hz : other_bands_hz) cases.push_back(knife_edge(device, 12, 300, 2000, hz));
  const std::vector<Response> screen = around_needle(device, 0);
  const double at_1 = apart(around_needle(device, 1), screen), at_tenth = apart(around_needle(device, 0.1), screen);
  cases.push_back({"needle wedge of 1 degree", "the field of a half plane, but for the order of the angle in radians",
                   at_1, glm::radians(1.0), "of free space"});
  cases.push_back({"needle wedge of 0.1 degrees", "the same", at_tenth, glm::radians(0.1), "of free space"});
  cases.push_back({"needle wedges", "a tenth of the angle differs by a tenth from the half plane",
                   std::abs(10 * at_tenth / at_1 - 1), 0.1, "of it"});
  return cases;
}

}  // namespace wavetracer::test
