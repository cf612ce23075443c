// SPDX-License-Identifier: Apache-2.0
// Tests scattering off vegetation: one crown in free space against an integral over its volume that is written here,
// against the closed form of a thin crown, and against the power that it absorbs; each path against the law; other
// crowns and walls in the way; both directions; and that nothing scatters where it is switched off.
#include <limits>
#include <numbers>

#include "radio/cells.hpp"
#include "radio/vegetation_law.hpp"
#include "simulation/run.hpp"
#include "wavetracer/device/volumes.h"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi, wavelength_m = speed_of_light / 5.9e9;

// Something for rays to meet, far below.
SceneFile plate() { return SceneFile(std::vector<Quad>{{{300, 300, -200}, {1, 0, 0}, {0, 1, 0}}}); }

VegetationConfig crown(const dvec3& centre, const dvec3& size, const char* shape = "spheroid") {
  VegetationConfig out;
  out.shape = VegetationShape::named(shape);
  out.centre_m = {centre.x, centre.y, centre.z};
  out.size_m = {size.x, size.y, size.z};
  return out;
}

Config leaves(const SceneFile& scene, const Points& from, const Points& to, double db_m, double most_db, double s) {
  Config config = config_of(scene.path(), from, to, 1000, 1);
  for (RadioEnd& end : config.transmitters)
    end.polarization = "V";  // receivers take both polarizations, so all of the power
  config.trace.scattering = true;
  MaterialConfig& material = config.materials.emplace_back();
  material.name = "vegetation";
  material.vegetation = "mixed";
  material.attenuation_db_m = db_m;
  material.max_attenuation_db = most_db;
  material.scattering = s;
  material.scattering_cross_polar = 0.25;
  return config;
}

double scattered_power(const Paths& paths, uint32_t rx = 0) {
  double sum = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.rx[i] == rx && paths.depth[i] == 1 && paths.vertex_interaction[paths.vertex_offset[i]] == scattering)
      sum += std::pow(10, paths.gain_db[i] / 10);
  return sum;
}

// Returns the distance from p, inside of the spheroid, to the point where the way to the end leaves it.
double way_out_m(const dvec3& p, const dvec3& end, const dvec3& centre, const dvec3& half) {
  const dvec3 q = (p - centre) / half, v = (end - p) / half;
  const double a = glm::dot(v, v), b = glm::dot(q, v), c = glm::dot(q, q) - 1;
  return (-b + std::sqrt(b * b - a * c)) / a * glm::length(end - p);
}

// Returns the coefficient of the power for dB per metre.
double per_metre(double db_m) { return db_m * std::numbers::ln10 / 10; }

constexpr double without_end = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a crown in free space: the received power is the integral over its volume") {
  const SceneFile file = plate();
  const dvec3 centre{0, 1, 6}, half{2.5, 2, 3.5}, from{-12, 0, 5}, to{9, 14, 2};
  Config config = leaves(file, {from}, {to}, 1.2, without_end, 0.6);
  config.vegetation = {crown(centre, 2.0 * half)};
  config.trace.tile_m = 0.4;
  const double sigma = per_metre(1.2);
  double integral = 0;
  const int n = 48;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double u = (i + 0.5) / n, theta = pi * (j + 0.5) / n, phi = 2 * pi * (k + 0.5) / n;
        const dvec3 p =
            centre +
            half * u * dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        const double d = way_out_m(p, from, centre, half) + way_out_m(p, to, centre, half);
        const double r1 = glm::distance(p, from), r2 = glm::distance(p, to);
        const double volume = half.x * half.y * half.z * u * u * std::sin(theta) * (1.0 / n) * (pi / n) * (2 * pi / n);
        integral += std::exp(-sigma * d) / (r1 * r1 * r2 * r2) * volume;
      }
  const double wanted = std::pow(wavelength_m / (4 * pi), 2) * 0.36 * sigma / (4 * pi) * integral;
  CHECK(scattered_power(run(config).paths) == doctest::Approx(wanted).epsilon(0.01));
  config.trace.tile_m = 1;
  CHECK(scattered_power(run(config).paths) == doctest::Approx(wanted).epsilon(0.05));
}

TEST_CASE("a thin crown far away: closed form, of every shape and however coarse") {
  const SceneFile file = plate();
  const dvec3 from{-900, 0, 0}, to{0, 800, 0}, size{4, 5, 3};
  const double volume[] = {60, pi / 4 * 60, pi / 6 * 60};
  const char* shapes[] = {"box", "cylinder", "spheroid"};
  for (int i = 0; i < 3; ++i) {
    Config config = leaves(file, {from}, {to}, 1e-4, without_end, 0.9);
    config.vegetation = {crown({0, 0, 0}, size, shapes[i])};
    const double wanted =
        std::pow(wavelength_m / (4 * pi), 2) * 0.81 * per_metre(1e-4) * volume[i] / (4 * pi) / std::pow(900.0 * 800, 2);
    for (const double tile_m : {1.0, 5.0, 50.0}) {
      config.trace.tile_m = tile_m;
      CHECK(scattered_power(run(config).paths) == doctest::Approx(wanted).epsilon(0.001));
    }
  }
}

TEST_CASE("a ball of leaves scatters no more than it takes, and most of it where it lets it out") {
  const SceneFile file = plate();
  const double radius = 3, away = 30, far = 3000;
  Points around;
  for (int i = 0; i < 24; ++i) {  // evenly over the sphere
    const double z = (2 * i + 1) / 24.0 - 1, phi = pi * (3 - std::sqrt(5.0)) * i;
    around.push_back(far * dvec3(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z));
  }
  for (const auto& [db_m, most_db, least] :
       std::vector<std::array<double, 3>>{{0.05, without_end, 0.9}, {4, without_end, 0.1}, {4, 6, 0.1}}) {
    CAPTURE(db_m);
    CAPTURE(most_db);
    Config config = leaves(file, {{-away, 0, 0}}, around, db_m, most_db, 1);
    config.vegetation = {crown({0, 0, 0}, dvec3(2 * radius))};
    config.trace.tile_m = 0.6;
    const Paths paths = run(config).paths;
    double mean = 0;
    for (uint32_t rx = 0; rx < around.size(); ++rx) mean += scattered_power(paths, rx) / 24;
    const double out = mean * 16 * pi * pi * far * far / (wavelength_m * wavelength_m);
    double taken = 0;  // power taken from the transmitter's, by the lengths of chords
    const double widest = std::asin(radius / away);
    for (int i = 0; i < 10000; ++i) {
      const double alpha = widest * (i + 0.5) / 10000, aside = away * std::sin(alpha);
      const double d = 2 * std::sqrt(radius * radius - aside * aside);
      const double loss_db = std::isinf(most_db) ? db_m * d : most_db * (1 - std::exp(-db_m * d / most_db));
      taken += (1 - std::pow(10, -loss_db / 10)) * std::sin(alpha) / 2 * widest / 10000;
    }
    CHECK(out < taken);
    CHECK(out > least * taken);
  }
}

TEST_CASE("two crowns and a wall: every path by the law, and the same both ways") {
  const SceneFile file(std::vector<Quad>{{{-20, 20, -5}, {50, 0, 0}, {0, 0, 20}}});
  const dvec3 from{-15, 0, 2}, to{12, 12, 3};
  Config config = leaves(file, {from}, {to}, 2, 9, 0.5);
  config.vegetation = {crown({-5, 2, 4}, {5, 5, 6}), crown({4, 6, 4}, {4, 6, 5}, "box"), crown({5, 25, 4}, {3, 3, 3})};
  config.trace.tile_m = 1.5;
  Simulation simulation(config);
  const Scene& scene = simulation.scene();
  const Paths paths = simulation.run_frame(0).paths;
  const VolumeTable table = volume_table(scene);
  const std::vector<Cell> cells = make_cells(scene, 1.5, 10000);
  const double g = per_metre(2), most = per_metre(9);
  std::array<size_t, 3> found{0, 0, 0};
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths.depth[i] == 0 || paths.vertex_interaction[paths.vertex_offset[i]] != scattering) continue;
    const dvec3 p = paths.vertex_position_m[paths.vertex_offset[i]];
    const uint32_t volume = paths.vertex_surface[paths.vertex_offset[i]] - static_cast<uint32_t>(scene.surfaces.size());
    REQUIRE(volume < 3);
    CHECK(paths.vertex_instance[paths.vertex_offset[i]] == no_instance);
    ++found[volume];
    const Cell* cell = nullptr;
    for (const Cell& each : cells)
      if (glm::distance(each.centre_m + scene.origin_m, p) < 1e-9) cell = &each;
    REQUIRE(cell != nullptr);
    CHECK(cell->volume == volume);
    double d = 0;
    for (const device::wt_volume& each : table.volumes)
      for (const dvec3& end : {from, to})
        d += device::wt_length_inside(&each, table.triangles.data(), end - scene.origin_m, p - scene.origin_m);
    const double r1 = glm::distance(p, from), r2 = glm::distance(p, to);
    const double power = std::pow(wavelength_m / (4 * pi), 2) * 0.25 * g * std::exp(-g * d / most) *
                         std::exp(-most * (1 - std::exp(-g * d / most))) * cell->volume_m3 / (4 * pi) /
                         std::pow(r1 * r2, 2);
    CHECK(std::abs(paths.gain_db[i] - 10 * std::log10(power)) < 1e-7);
  }
  CHECK(found[0] > 30);
  CHECK(found[1] > 20);
  CHECK(found[2] == 0);  // behind the wall, for both

  std::swap(config.transmitters, config.receivers);
  std::swap(config.transmitters[0].polarization, config.receivers[0].polarization);
  config.transmitters[0].name = "tx0";
  config.receivers[0].name = "rx0";
  const Paths back = run(config).paths;
  CHECK(scattered_power(back) == doctest::Approx(scattered_power(paths)).epsilon(1e-9));
}

TEST_CASE("off, or of a material that does not scatter: the same paths to the last bit, and no such pass") {
  const SceneFile file(std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"},
                                         {{{{-30, 8, 0}, {60, 0, 0}, {0, 0, 12}}}, "glass"}});
  Config config = leaves(file, {{-12, 1.3, 5}}, {{11, -2.1, 1.5}}, 1, 30, 0.7);
  config.vegetation = {crown({-5, 2, 4}, {5, 5, 6})};
  config.trace.max_depth = 3;
  config.trace.rays = 20000;
  CHECK(scattered_power(run(config).paths) > 0);
  config.trace.scattering = false;
  Simulation off(config);
  off.profile_every(1);
  const FrameResult frame = off.run_frame(0);
  for (const auto& [kernel, time] : frame.kernels) CHECK(kernel.find("crowns") == std::string::npos);
  CHECK(frame.seconds.count("crowns") == 0);
  config.materials[0].scattering = 0;
  CHECK(identical(frame.paths, run(config).paths));
  config.trace.scattering = true;
  const Simulation smooth(config);
  CHECK_FALSE(smooth.features().at("scattering").on);
  CHECK(identical(frame.paths, run(config).paths));
}
