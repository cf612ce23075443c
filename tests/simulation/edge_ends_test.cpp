// SPDX-License-Identifier: Apache-2.0
// Compares the field past the corner of a plate with Kirchhoff's integral, with trace.edge_ends: no step where the
// point of diffraction leaves an edge, the same bits on device and host, and the same field the other way.
#include "radio/fields.hpp"
#include "simulation/bends.hpp"
#include "simulation/frame.hpp"
#include "simulation/visible_paths.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Complex = std::complex<double>;
constexpr double frequency_hz = 1e9, leg_m = 20, width_m = 3, height_m = 2;
constexpr int places = 121;

// The plate hangs upright in the plane x = 0 around the origin; receivers are on a line past the shadow of a corner.
Config past_a_corner(const MeshFile& scene, bool edge_ends) {
  Points receivers;
  for (int i = 0; i < places; ++i) {
    const double t = i / (places - 1.0);
    receivers.push_back({leg_m, 0.1 + t * 3.9, 0.15 + t * 2.6});
  }
  Config config = config_of(scene.path(), {{-leg_m, 0.3, 0.2}}, receivers, 20000, 2);
  config.radio.frequency_hz = frequency_hz;
  config.trace.diffraction = true;
  config.trace.edge_ends = edge_ends;
  for (auto* ends : {&config.transmitters, &config.receivers})
    for (RadioEnd& end : *ends) end.polarization = "VH";
  return config;
}

MeshFile plate() {
  const Part part{{{{0, -width_m / 2, -height_m / 2}, {0, width_m, 0}, {0, 0, height_m}}}};
  return MeshFile({mesh_of(part)});
}

// The mean of both polarisations, over the field in free space; Kirchhoff's integral knows none. H points the other way
// at the receiver.
std::vector<Complex> fields_of(const Config& config, const Paths& paths) {
  std::vector<Complex> out(config.receivers.size());
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto &from = config.transmitters[paths.tx[i]].position_m, &to = config.receivers[paths.rx[i]].position_m;
    const double direct_m = std::hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
    const double k = 2 * M_PI * frequency_hz / speed_of_light;
    const Complex phase = std::polar(2 * k * direct_m, -k * (paths.delay_s[i] * speed_of_light - direct_m));
    out[paths.rx[i]] += (paths.a[i][0] - paths.a[i][3]) / 2.0 * phase;
  }
  return out;
}

// The part of the wave that a strip between -size / 2 and size / 2 takes, by Simpson's rule.
Complex covered(double size, double from, double to) {
  constexpr int steps = 4000;
  const double k = 2 * M_PI * frequency_hz / speed_of_light, middle = (from + to) / 2;
  Complex sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double at = size * (static_cast<double>(i) / steps - 0.5) - middle;
    sum += (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / 3 * std::polar(size / steps, -k * at * at / leg_m);
  }
  return sum * std::polar(std::sqrt(k / leg_m / M_PI), M_PI / 4);
}

// The largest step and the largest error, in parts of the field in free space.
std::pair<double, double> step_and_error(const Config& config, const std::vector<Complex>& fields) {
  double step = 0, error = 0;
  Complex before = 0;
  for (size_t i = 0; i < fields.size(); ++i) {
    const auto& to = config.receivers[i].position_m;
    const Complex truth = 1.0 - covered(width_m, 0.3, to[1]) * covered(height_m, 0.2, to[2]);
    const Complex off = fields[i] - truth;
    if (i > 0) step = std::max(step, std::abs(off - before));
    error = std::max(error, std::abs(off));
    before = off;
  }
  return {step, error};
}

}  // namespace

TEST_CASE("past the corner of a plate the field is Kirchhoff's, and has no step") {
  const MeshFile scene = plate();
  const Config with = past_a_corner(scene, true), without = past_a_corner(scene, false);
  const auto [step, error] = step_and_error(with, fields_of(with, run(with).paths));
  const auto [old_step, old_error] = step_and_error(without, fields_of(without, run(without).paths));
  MESSAGE("steps ", step, " and ", old_step, ", errors ", error, " and ", old_error);
  CHECK(step < 3e-3);
  CHECK(error < 0.02);
  CHECK(old_step > 0.4);
}

TEST_CASE("over the end of an edge the field is continuous to 1e-3, at places a tenth of a millimetre apart") {
  const MeshFile scene = plate();
  Config config = past_a_corner(scene, true);
  // The points of diffraction on the upright edge leave it at z = 1; those of the horizontal one at y = 1.5.
  for (size_t i = 0; i < config.receivers.size(); ++i)
    config.receivers[i].position_m = {leg_m, 2.3, 1.8 + 1e-4 * (static_cast<double>(i) - 60)};
  const std::vector<Complex> fields = fields_of(config, run(config).paths);
  for (size_t i = 1; i < fields.size(); ++i) CHECK(std::abs(fields[i] - fields[i - 1]) < 1e-3);
}

TEST_CASE("paths over ends have the same bits on device and host, and the same field the other way") {
  const MeshFile scene = plate();
  Config config = past_a_corner(scene, true);
  Setup s = make_setup(config, "");
  FrameLoop loop(s);
  Config all = s.plan->asked;
  all.trace = s.plan->trace;
  const FieldModel host(s.plan->scene, all, s.plan->world.fleet.models, s.plan->world.fleet.instances);
  const FrameResult found = loop.run(
      FrameTask::of_drive({.frame = 0, .pose = [&] { return s.plan->world.state(0); }, .names = FrameNames::none()}));
  const Paths expected = host.compute(0, read_visible(s), found.world);
  const auto sorted = [](const Paths& paths) {
    std::vector<std::tuple<uint32_t, double, std::array<Complex, 4>>> rows;
    for (size_t i = 0; i < paths.size(); ++i) rows.emplace_back(paths.rx[i], paths.delay_s[i], paths.a[i]);
    std::ranges::sort(rows, {}, [](const auto& row) {
      const auto& a = std::get<2>(row);
      return std::tuple(std::get<0>(row), std::get<1>(row), a[0].real(), a[3].real());
    });
    return rows;
  };
  CHECK(found.paths.size() > places);
  CHECK(sorted(found.paths) == sorted(expected));

  std::swap(config.transmitters, config.receivers);
  const Paths back = run(config).paths;
  REQUIRE(back.size() == found.paths.size());
  std::vector<Complex> there(places), again(places);
  for (size_t i = 0; i < back.size(); ++i) {
    there[found.paths.rx[i]] += found.paths.a[i][0] * std::polar(1.0, -1e9 * found.paths.delay_s[i]);
    again[back.tx[i]] += back.a[i][0] * std::polar(1.0, -1e9 * back.delay_s[i]);
  }
  for (int i = 0; i < places; ++i) CHECK(std::abs(there[i] - again[i]) < 1e-9 * std::abs(there[i]) + 1e-15);
}
