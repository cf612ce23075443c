// SPDX-License-Identifier: Apache-2.0
// The total field across the shadow boundaries of free-standing wedges and screens: it must not jump.
// Float32 is off by up to 0.03 mm where a ray passes an edge, so receivers stand closer than that as well.
#include <glm/trigonometric.hpp>

#include "hard/responses.hpp"

namespace wavetracer::test {
namespace {

constexpr double radius_m = 5, skew_m = -1;  // place of receivers, from the edge and along it
// Rotation of the whole scene about the edge, so that no coordinate is exact in float32.
constexpr double turned_rad = 0.37;

glm::dvec3 at_azimuth(double rho_m, double azimuth_rad, double z_m) {
  return {rho_m * std::cos(azimuth_rad + turned_rad), rho_m * std::sin(azimuth_rad + turned_rad), z_m};
}

struct Boundary {
  uint32_t tx;
  double azimuth_rad;
};

HardCase case_of(const std::string& device, double interior_rad, const std::string& material, bool transmits,
                 double hz = frequency_hz) {
  const double exterior_rad = 2 * pi - interior_rad, width_m = 30;
  std::vector<Quad> faces{{at_azimuth(0, 0, -60), at_azimuth(width_m, 0, 0), {0, 0, 120}}};
  if (interior_rad > 0) faces.push_back({at_azimuth(0, 0, -60), at_azimuth(width_m, exterior_rad, 0), {0, 0, 120}});
  // One source that lights face 0 alone, one that lights both. No boundary is at the azimuth of its source, where paths
  // by the upper and lower rims would end at the corners of the mesh.
  std::vector<double> sources{0.55 * (pi - interior_rad)};
  std::vector<Boundary> boundaries{{0, pi + sources[0]}, {0, pi - sources[0]}};
  if (interior_rad > 0) {
    sources.push_back(exterior_rad / 2 + 0.13 * interior_rad);
    boundaries.insert(boundaries.end(), {{1, pi - sources[1]}, {1, 2 * exterior_rad - pi - sources[1]}});
  }
  Points transmitters, receivers;
  for (const double azimuth : sources) transmitters.push_back(at_azimuth(8, azimuth, 3));
  const std::vector<double> at_m = boundary_steps(hz);
  for (const Boundary& boundary : boundaries)
    for (const double step : at_m)
      receivers.push_back(at_azimuth(radius_m, boundary.azimuth_rad + step / radius_m, skew_m));

  const SceneFile file({Part{faces, material}});
  Config config = config_of(file.path(), transmitters, receivers, 20000, 3);
  config.trace.diffraction = true;
  config.trace.diffraction_rays = 1000;
  config.trace.transmission = transmits;
  config.radio.frequency_hz = hz;
  config.scene.extrapolate_materials = true;  // ITU-R knows metal and concrete from 1 GHz on
  const Paths paths = run(config, device).paths;

  HardCase out{interior_rad > 0 ? fmt::format("{:.0f} degree wedge", glm::degrees(interior_rad)) : "thin screen",
               "the total field is continuous at its shadow boundaries, V and H", 0, 1e-4, "of the field"};
  out.name += fmt::format(", {}{}, {} GHz", material, transmits ? ", with transmission" : "", hz / 1e9);
  for (size_t b = 0; b < boundaries.size(); ++b) {
    const auto first = static_cast<uint32_t>(b * at_m.size());
    const auto last = static_cast<uint32_t>(first + at_m.size() - 1);
    const uint32_t tx = boundaries[b].tx;
    const std::vector<Response> h = responses_at(hz, paths, tx, receivers.size());
    for (const size_t port : {0, 1}) out.measured = std::max(out.measured, boundary_jump(at_m, h, first, port));
    // A path that passes the edge, or is reflected beside it, must exist on one side alone, or this is no boundary.
    // If walls transmit, the direct path continues as another one.
    const bool ends = geometrical_paths(paths, tx, first) != geometrical_paths(paths, tx, last);
    if (!ends && !(transmits && b == 0)) out.measured = std::numeric_limits<double>::infinity();
  }
  return out;
}

}  // namespace

HardCases shadow_boundaries(const std::string& device) {
  HardCases cases;
  for (const double interior_deg : {10, 30, 60, 90, 120, 150, 170})
    for (const auto& [material, transmits] : {std::pair{"metal", false}, {"concrete", false}, {"glass", true}})
      cases.push_back(case_of(device, glm::radians(interior_deg), material, transmits));
  for (const auto& [material, transmits] :
       {std::pair{"metal", false}, {"concrete", false}, {"concrete", true}, {"glass", true}})
    cases.push_back(case_of(device, 0, material, transmits));
  for (const double hz : other_bands_hz) {
    cases.push_back(case_of(device, glm::radians(90.0), "concrete", false, hz));
    cases.push_back(case_of(device, glm::radians(30.0), "metal", false, hz));
    cases.push_back(case_of(device, 0, "glass", true, hz));
  }
  return cases;
}

}  // namespace wavetracer::test
