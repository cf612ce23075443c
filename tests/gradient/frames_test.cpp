// SPDX-License-Identifier: Apache-2.0
// Derivatives of paths that frames have found: their code has the fields' values for every path, also beside shadow
// boundaries and in chains of edges; all vertices are those of solved paths; delays have the slopes of their closed
// form.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ctime>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "gradient/frame_gradient.hpp"
#include "gradient/path_gradient.hpp"
#include "radio/constants.hpp"
#include "simulation/bends.hpp"
#include "simulation/frame.hpp"
#include "simulation/town.hpp"
#include "simulation/visible_paths.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

glm::dvec3 unit(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// The seconds of all cores that some work takes, and its result. Other programs on these cores hardly count.
template <class Work>
auto timed(Work work) {
  const std::clock_t begin = std::clock();
  auto result = work();
  return std::pair(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, std::move(result));
}

// The derivatives of a row that a sum over records of one material does not change.
using Sums = std::map<PathParameter, std::pair<std::complex<double>, double>>;
Sums sums_of(const PathGradients& of, size_t row) {
  Sums out;
  for (uint64_t entry = of.first[row]; entry < of.first[row + 1]; ++entry) {
    auto& [a, others] = out[of.parameter[entry]];
    for (const auto& port : of.a[entry]) a += port;
    if (of.material[entry] == no_material_number)
      others += of.delay_s[entry] + 1e-9 * of.aoa_phi_rad[entry] + 2e-9 * of.aod_theta_rad[entry];
  }
  return out;
}

// Derivatives of the columns of a frame are those of its solved geometry, up to the rounding of coordinates. The solved
// geometry may have a path several times.
void check_way_back(FrameGradient& model, const FrameResult& frame, const ModelGradients& solved) {
  const PathGradients of = model(frame, {.orientations = true});
  REQUIRE(of.first.size() == frame.paths.size() + 1);
  CHECK(std::ranges::all_of(of.material, [&](uint32_t material) {
    return material == no_material_number || !of.materials.at(material).empty();
  }));
  CHECK(std::ranges::count(of.gap, GradientGap::none) == static_cast<ptrdiff_t>(of.size()));
  const auto key = [](const Paths& paths, size_t row) {
    return std::tuple(paths.tx[row], paths.rx[row], paths.delay_s[row], paths.gain_db[row], paths.aod_phi_rad[row]);
  };
  std::map<std::tuple<uint32_t, uint32_t, double, double, double>, size_t> rows;
  for (size_t row = 0; row < solved.paths.size(); ++row) rows[key(solved.paths, row)] = row;
  size_t wrong = 0, alone = 0;
  for (size_t row = 0; row < frame.paths.size(); ++row) {
    const auto twin = rows.find(key(frame.paths, row));
    alone += twin == rows.end();
    if (twin == rows.end()) continue;
    const Sums own = sums_of(of, row), expected = sums_of(solved, twin->second);
    wrong += own.size() != expected.size();
    for (const auto& [parameter, slopes] : expected) {
      const auto& [a, others] = own.at(parameter);
      wrong += !(std::abs(a - slopes.first) <= 1e-6 * std::abs(slopes.first) + 1e-15);
      wrong += !(std::abs(others - slopes.second) <= 1e-6 * std::abs(slopes.second) + 1e-18);
    }
  }
  CHECK(wrong == 0);
  CHECK(alone <= frame.paths.size() / 100);  // a path that another one completes may have fields of its own here
}

// Checks the first frames of a configuration. Returns how many interactions of which kind they have.
std::map<uint8_t, size_t> check_frames(const Config& config, uint32_t frames) {
  Setup s = make_setup(config, "");
  FrameLoop loop(s);
  Config all = s.plan->asked;
  all.trace = s.plan->trace;
  const GradientModel model(s.plan->scene, all, s.plan->world.fleet.models, s.plan->world.fleet.instances);
  FrameGradient model_of_frames(s.plan->scene, all, s.plan->world.fleet.models, s.plan->world.fleet.instances);
  const FieldModel fields(s.plan->scene, all, s.plan->world.fleet.models, s.plan->world.fleet.instances);
  std::map<uint8_t, size_t> kinds;
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const FrameResult found = loop.run(FrameTask::of_drive(
        {.frame = frame, .pose = [&] { return s.plan->world.state(frame); }, .names = FrameNames::none()}));
    const PathGeometry geometry = read_visible(s);
    const auto [fields_s, paths] = timed([&] { return fields.compute(frame, geometry, found.world); });
    const auto [ends_s, ends] =
        timed([&] { return model.compute(frame, geometry, found.world, {.materials = false, .positions = true}); });
    const auto [all_s, of] = timed([&] { return model.compute(frame, geometry, found.world, {.orientations = true}); });
    MESSAGE(paths.size(), " paths, processor time: fields ", 1000 * fields_s, " ms, with their ", ends.size(),
            " derivatives by positions ", 1000 * ends_s, " ms (", ends_s / fields_s, " times), with all ", of.size(),
            " derivatives ", 1000 * all_s, " ms");
    CHECK(of.paths.a == paths.a);
    check_way_back(model_of_frames, found, of);
    CHECK(of.paths.size() > 3);
    size_t gaps = 0, wrong = 0, checked = 0;
    for (size_t row = 0; row < of.paths.size(); ++row)
      for (uint64_t entry = of.first[row]; entry < of.first[row + 1]; ++entry) {
        gaps += of.gap[entry] != GradientGap::none;
        const int axis = static_cast<int>(of.parameter[entry]) - static_cast<int>(PathParameter::tx_x);
        if (axis < 0 || axis >= 6) continue;
        const glm::dvec3 leg = axis < 3 ? unit(of.paths.aod_theta_rad[row], of.paths.aod_phi_rad[row])
                                        : unit(of.paths.aoa_theta_rad[row], of.paths.aoa_phi_rad[row]);
        ++checked;
        wrong += !(std::abs(of.delay_s[entry] * speed_of_light_m_s + leg[axis % 3]) < 1e-9);
      }
    CHECK(gaps == 0);
    CHECK(wrong == 0);
    CHECK(checked == 6 * of.paths.size());
    for (const uint8_t kind : of.paths.vertex_interaction) ++kinds[kind];
  }
  return kinds;
}

}  // namespace

TEST_CASE("derivatives of the paths of a town: reflections, walls that are passed, one edge and two") {
  Config config = small_town(20000, 3);
  config.trace.diffraction = true;
  config.trace.transmission = true;
  config.trace.max_diffractions = 2;
  auto kinds = check_frames(config, 1);
  CHECK(kinds[reflection] > 100);
  CHECK(kinds[transmission] > 10);
  CHECK(kinds[diffraction] > 100);
}

TEST_CASE("derivatives of the paths of a town: rough surfaces, leaves, and ends of edges") {
  Config config = small_town(2000, 2);
  config.trace.scattering = true;
  config.trace.tile_m = 8;
  config.trace.diffraction = true;
  config.trace.edge_ends = true;
  config.materials.emplace_back();
  config.materials[0].name = "concrete";
  config.materials[0].scattering = 0.3;
  VegetationConfig& crown = config.vegetation.emplace_back();
  crown.centre_m = {20, 1, 5};
  crown.size_m = {9, 8, 9};
  crown.material = "vegetation";
  CHECK(check_frames(config, 1)[scattering] > 200);
}

TEST_CASE("derivatives of the paths of vehicles that drive, over two edges too") {
  Config config = small_town(20000, 2);
  let_vehicles_hear(config);
  config.trace.diffraction = true;
  config.trace.max_diffractions = 2;
  CHECK(check_frames(config, 2)[diffraction] > 100);
}

TEST_CASE("derivatives of paths over a row of four screens") {
  std::vector<Quad> quads{{{-40, -60, 0}, {140, 0, 0}, {0, 120, 0}}};
  for (uint32_t i = 0; i < 4; ++i) {
    const double x = 10.0 * (i + 1), from_middle = x - 25;
    quads.push_back({{x, -50, 0}, {0, 100, 0}, {0, 0, 12 - 0.005 * from_middle * from_middle}});
  }
  const SceneFile file(quads);
  Config config;
  config.scene.file = file.path().string();
  config.radio.frequency_hz = carrier_hz;
  config.transmitters = {{"tx", {-9.3, 0.7, 2.1}}};
  config.receivers = {{"rx", {59.1, -3.2, 1.7}}};
  config.trace = diffracting(50000, 2);
  config.trace.max_diffractions = 4;
  CHECK(check_frames(config, 1)[diffraction] > 8);
}
