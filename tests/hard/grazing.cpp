// SPDX-License-Identifier: Apache-2.0
// Two-ray ground: figures that were computed elsewhere, grazing at 1e-6 rad, and grounds of 10 km, also made of
// slivers. Grounds are half spaces; "conductor" has 1e18 S/m and reflects with -1.
#include "hard/responses.hpp"
#include "simulation/drive.hpp"

namespace wavetracer::test {
namespace {

constexpr double side_m = 10000;

MaterialConfig material(const std::string& name) {
  MaterialConfig out;
  out.name = name;
  out.thickness_m = std::numeric_limits<double>::infinity();
  if (name == "conductor") out.permittivity = 1, out.conductivity_s_m = 1e18;
  return out;
}

// Makes a ground of 10 km by 10 km around the origin: strips along x, narrow ones in the middle where the way runs.
Mesh ground(const std::string& material, uint32_t narrow, double narrow_m) {
  Mesh mesh{{}, {}, material};
  std::vector<double> lines{-side_m / 2};
  for (uint32_t i = 0; i < narrow; ++i) lines.push_back((i - narrow / 2.0) * narrow_m);
  lines.push_back(side_m / 2);
  for (const double y : lines) mesh.vertices.insert(mesh.vertices.end(), {{-side_m / 2, y, 0}, {side_m / 2, y, 0}});
  for (uint32_t i = 0; i + 1 < lines.size(); ++i)
    mesh.triangles.insert(mesh.triangles.end(), {{2 * i, 2 * i + 1, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 2}});
  return mesh;
}

Paths over(const std::string& device, const Mesh& mesh, const Points& receivers, const glm::dvec3& tx) {
  const MeshFile file({mesh});
  Config config = config_of(file.path(), {tx}, receivers, 20000, 1);
  config.materials = {material(mesh.material)};
  return run(config, device).paths;
}

// Isotropic antennas are 1.5 m above the ground; the values are reference figures of two-ray models.
void add_figures(const std::string& device, HardCases& cases) {
  struct Figure {
    const char* material;
    double distance_m, gain_db;
    size_t port;  // 0: V, 3: H
  };
  for (const Figure& f : {Figure{"conductor", 10, -63.2575, 3},
                          {"conductor", 100, -90.9089, 3},
                          {"conductor", 500, -101.3683, 3},
                          {"conductor", 1000, -113.0687, 3},
                          {"medium_dry_ground", 100, -91.2969, 0}}) {
    const Paths paths = over(device, ground(f.material, 0, 0), {{f.distance_m, 0, 1.5}}, {0, 0, 1.5});
    const double gain_db = decibels(std::abs(responses(paths, 0, 1)[0][f.port]));
    cases.push_back({fmt::format("two rays over {}, {} m", f.material, f.distance_m), fmt::format("{} dB", f.gain_db),
                     std::abs(gain_db - f.gain_db), 1e-4, "dB"});
  }
}

// Antennas 5 mm above the ground, 10 km apart: the ground is met at 1e-6 rad, and the wave reflected there all but
// cancels the direct one. The difference is -j k (L1 - L0), whose digits are those of the two delays.
void add_millionth(const std::string& device, HardCases& cases) {
  const double height_m = 0.005, distance_m = side_m - 2;
  for (const auto& [name, strips, width_m] :
       {std::tuple{"two triangles", 0u, 0.0}, {"slivers 10 mm wide", 100u, 0.01}}) {
    const glm::dvec3 tx{-distance_m / 2, 0.0013, height_m}, rx{distance_m / 2, -0.0017, height_m};
    const Paths paths = over(device, ground("conductor", strips, width_m), {rx}, tx);
    HardCase out{fmt::format("grazing at 1e-6 rad, ground of {}", name),
                 "two paths, their sum lambda / (4 pi L) 2 sin(k (L1 - L0) / 2), H",
                 std::numeric_limits<double>::infinity(), 0.01, "dB"};
    if (kinds_between(paths, 0, 0) == "LOS R") {
      const double direct_m = glm::distance(tx, rx), excess_m = 4 * height_m * height_m / (2 * direct_m);
      const double exact = friis(direct_m) * 2 * std::sin(pi * excess_m / wavelength_m);
      out.measured = std::abs(decibels(std::abs(responses(paths, 0, 1)[0][3]) / exact));
    }
    cases.push_back(out);
  }
}

// Two rays over a conductor, H, at other frequencies: the sum of two spherical waves, the second with -1.
void add_bands(const std::string& device, HardCases& cases) {
  const double height_m = 1.5, distance_m = 73;
  const double straight_m = distance_m, mirrored_m = std::hypot(distance_m, 2 * height_m);
  for (const double hz : other_bands_hz) {
    const MeshFile file({ground("conductor", 0, 0)});
    Config config = config_of(file.path(), {{0, 0, height_m}}, {{distance_m, 0, height_m}}, 20000, 1);
    config.materials = {material("conductor")};
    config.radio.frequency_hz = hz;
    const std::vector<Response> h = responses_at(hz, run(config, device).paths, 0, 1);
    const auto wave = [&](double m) { return std::polar(friis(m, hz), -2 * pi * hz / speed_of_light * m); };
    const Complex exact = wave(straight_m) - wave(mirrored_m);
    cases.push_back({fmt::format("two rays over a conductor, {} m, {} GHz", distance_m, hz / 1e9),
                     "the sum of both waves, H", std::abs(std::abs(h[0][3]) / std::abs(exact) - 1), 1e-6, "of it"});
  }
}

// The same ground, cut in another way along the way of a receiver: paths and gains must not change.
HardCase slivers(const std::string& device) {
  Points receivers;
  for (int i = 0; i < 100; ++i) receivers.push_back({-4000 + 90.0 * i, -0.47 + 0.0093 * i, 1.5});
  const glm::dvec3 tx{-4900, 0.02, 10};
  const Paths cut = over(device, ground("medium_dry_ground", 100, 0.01), receivers, tx);
  const Paths whole = over(device, ground("medium_dry_ground", 0, 0), receivers, tx);
  return {"ground of slivers 10 mm by 10 km", "two paths at 100 receivers, gains of two triangles",
          whole.size() == 200 ? difference(cut, whole).gain_db : std::numeric_limits<double>::infinity(), 1e-9, "dB"};
}

}  // namespace

HardCases grazing(const std::string& device) {
  HardCases cases;
  add_figures(device, cases);
  add_bands(device, cases);
  add_millionth(device, cases);
  cases.push_back(slivers(device));
  return cases;
}

}  // namespace wavetracer::test
