// SPDX-License-Identifier: Apache-2.0
// Energy: the reflection and transmission of a slab, the scattering of a rough plate into all directions, and its
// mirrored wave. Coefficients are the gains of paths, divided by those of free space.
#include "hard/responses.hpp"
#include "simulation/drive.hpp"

namespace wavetracer::test {
namespace {

// |R|^2 + |T|^2 of a slab at several angles, less 1; V and H are TM and TE, or the other way round.
std::vector<double> balances(const std::string& device, double conductivity_s_m, double thickness_m, double hz) {
  MaterialConfig slab;
  slab.name = "slab";
  slab.permittivity = 5.3;
  slab.conductivity_s_m = conductivity_s_m;
  slab.thickness_m = thickness_m;
  const SceneFile file({Part{{{{0, -500, -500}, {0, 1000, 0}, {0, 0, 1000}}}, "slab"}});
  const glm::dvec3 tx{-2, 0, 0};
  Points receivers;
  for (const double y : {0.01, 0.5, 1.5, 4.0, 12.0, 60.0, 300.0})  // to 89 degrees; behind, then in front
    receivers.insert(receivers.end(), {{2, y, 0}, {-2, y, 0}});
  Config config = config_of(file.path(), {tx}, receivers, 20000, 1);
  config.materials = {slab};
  config.trace.transmission = true;
  config.radio.frequency_hz = hz;
  const Paths paths = run(config, device).paths;
  std::vector<double> out;
  for (uint32_t rx = 0; rx < receivers.size(); rx += 2)
    for (const size_t port : {0, 3}) {
      double power = 0;
      for (const uint32_t side : {rx, rx + 1})
        for (const size_t row : rows_between(paths, 0, side))
          if (paths.depth[row] == 1)
            power += std::norm(paths.a[row][port] / friis(paths.delay_s[row] * speed_of_light, hz));
      out.push_back(power - 1);
    }
  return out;
}

void add_slabs(const std::string& device, HardCases& cases) {
  double lossless = 0, lossy = -1, dark = 1;
  for (const auto& [thickness_m, hz] : {std::pair{0.003, frequency_hz},
                                        {0.02, frequency_hz},
                                        {0.3, frequency_hz},
                                        {0.02, 0.7e9},
                                        {0.003, 28e9},
                                        {0.02, 60e9}}) {
    for (const double b : balances(device, 0, thickness_m, hz)) lossless = std::max(lossless, std::abs(b));
    for (const double b : balances(device, 0.05, thickness_m, hz)) {
      lossy = std::max(lossy, b);
      dark = std::min(dark, b + 1);
    }
  }
  cases.push_back({"slabs without losses, 0 to 89 degrees", "|R|^2 + |T|^2 = 1", lossless, 1e-9, "of the power"});
  cases.push_back({"slabs with losses", "|R|^2 + |T|^2 <= 1, and not 0", dark > 0.01 ? lossy : NAN, 0, "above 1"});
}

// A plate of one triangle, which is one tile with its centre at the origin, under a hemisphere of receivers. Midpoints
// in the cosine and the azimuth are exact for Lambert's law. scattered: the power that comes back divided by the
// arriving power; mirrored: the power of the mirrored wave divided by that of a mirror.
struct Shares {
  double scattered, mirrored;
};
Shares shares(const std::string& device, double angle_rad, double lobe, double cross_polar) {
  constexpr int rings = 16, round = 24;
  constexpr double radius_m = 10, far_m = 15;
  MaterialConfig rough;
  rough.name = "rough";
  rough.permittivity = 1;
  rough.conductivity_s_m = 1e18;
  rough.scattering = 0.6;
  rough.scattering_lobe = lobe;
  rough.scattering_cross_polar = cross_polar;
  constexpr double area_m2 = 1.125;
  const MeshFile file({{{{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}}, {{0, 1, 2}}, "rough"}});
  Points receivers{{far_m * std::sin(angle_rad), 0, far_m * std::cos(angle_rad)}};
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < round; ++j) {
      const double cosine = (i + 0.5) / rings, sine = std::sqrt(1 - cosine * cosine);
      const double azimuth = 2 * pi * (j + 0.5) / round;
      receivers.push_back(radius_m * glm::dvec3{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
    }
  const glm::dvec3 tx{-receivers[0].x, 0, receivers[0].z};
  Config config = config_of(file.path(), {tx}, receivers, 50000, 1);
  config.materials = {rough};
  config.trace.scattering = true;
  const Paths paths = run(config, device).paths;
  Shares out{0, 0};
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::string kinds = kinds_of(paths, i);
    // Port V sends; both ports receive.
    const double power = std::norm(paths.a[i][0]) + std::norm(paths.a[i][2]);
    if (kinds == "S" && paths.rx[i] > 0) out.scattered += power / (friis(1) * friis(1));
    if (kinds == "R" && paths.rx[i] == 0) out.mirrored = power / std::pow(friis(2 * far_m), 2);
  }
  // The sum of power densities over the hemisphere is divided by that of the wave at the plate times its area across
  // the wave.
  out.scattered *= radius_m * radius_m * (2 * pi / (rings * round)) * far_m * far_m / (area_m2 * std::cos(angle_rad));
  return out;
}

void add_rough_plates(const std::string& device, HardCases& cases) {
  double worst = 0;
  for (const double angle_deg : {0.0, 45.0, 75.0})
    for (const double cross_polar : {0.0, 0.3}) {
      const Shares s = shares(device, angle_deg * pi / 180, 0, cross_polar);
      worst = std::max({worst, std::abs(s.scattered - 0.36), std::abs(s.scattered + s.mirrored - 1)});
    }
  cases.push_back({"rough conductor, Lambert's law", "scattered S^2, with the mirrored wave all of the power", worst,
                   1e-6, "of the power"});
  double most = 0, least = 1;
  for (const double angle_deg : {0.0, 45.0, 75.0})
    for (const double lobe : {1.0, 4.0}) {
      const double share = shares(device, angle_deg * pi / 180, lobe, 0).scattered / 0.36;
      most = std::max(most, share);
      least = std::min(least, share);
    }
  cases.push_back({"rough conductor, directive lobes", "scattered at most S^2, at least half of it",
                   least > 0.5 ? most : NAN, 1, "of S^2"});
}

}  // namespace

HardCases energy(const std::string& device) {
  HardCases cases;
  add_slabs(device, cases);
  add_rough_plates(device, cases);
  return cases;
}

}  // namespace wavetracer::test
