// SPDX-License-Identifier: Apache-2.0
// Paths over targets: the radar equation, laws of 3GPP against their formula written once more, polarisation, both
// directions, one mirror before and after against images, and that nothing changes without targets.
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "radio/target_kinds.hpp"
#include "simulation/radar_world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;

// |a|^2 of the radar equation between isotropic antennas.
double radar_gain(double section_m2, double before_m, double after_m) {
  return radar_wavelength_m * radar_wavelength_m * section_m2 / (std::pow(4 * pi, 3) * std::pow(before_m * after_m, 2));
}

double degrees_between(double a, double b) { return std::remainder(a - b, 360); }

// Equations 7.9.2-2 and 7.9.2-3 of TR 38.901 in dBsm. Both directions point away from the target, in its axes.
double section_db(const KindLaw& law, const KindLobe* only, const dvec3& to_source, const dvec3& to_goal) {
  const double beta = 2 * std::atan2(glm::length(to_source - to_goal), glm::length(to_source + to_goal));
  const double bistatic = law.k[0] * std::sin(law.k[1] * beta / 2) - law.k[2] * std::log10(std::cos(beta / 2));
  const dvec3 middle = glm::normalize(to_source + to_goal);
  const double zenith = std::acos(middle.z) * 180 / pi, azimuth = std::atan2(middle.y, middle.x) * 180 / pi;
  for (const KindLobe& lobe : law.lobes) {
    if (only && &lobe != only) continue;
    const double from = lobe.counts_deg[2], width = lobe.counts_deg[3] - from;
    double offset = std::fmod(azimuth - from, 360);
    if (offset < 0) offset += 360;
    if (zenith < lobe.counts_deg[0] || zenith > lobe.counts_deg[1] || offset > width) continue;
    const auto loss = [&](double angle, double at_3_db) {
      return at_3_db > 0 ? std::min(12 * std::pow(angle / at_3_db, 2), lobe.range_db) : 0.0;
    };
    const double lost = std::min(loss(zenith - lobe.zenith_deg, lobe.zenith_width_deg) +
                                     loss(degrees_between(azimuth, lobe.azimuth_deg), lobe.azimuth_width_deg),
                                 lobe.range_db);
    return std::max(lobe.peak_dbsm - lost - bistatic, lobe.peak_dbsm - lobe.range_db);
  }
  return -std::numeric_limits<double>::infinity();
}

double deviation(double a, double b) { return std::abs(a / b - 1); }

}  // namespace

TEST_CASE("the radar equation: one point, apart and with both antennas in one place") {
  const SceneFile file(far_plate);
  const dvec3 from{1.5, -2, 1}, to{-3, 4, 2}, point{41, 13, 0.7};
  for (const dvec3& receiver : {to, from}) {
    Config config = radar_world(file, {from}, {receiver});
    TargetModelConfig model;
    model.rcs_dbsm = {7.5};
    model.xpr_db = 20;
    add_target(config, model, point);
    const Paths paths = run(config).paths;
    REQUIRE(echoes(paths).size() == 1);
    const size_t i = echoes(paths)[0];
    const double before_m = glm::distance(from, point), after_m = glm::distance(receiver, point);
    const double expected = radar_gain(std::pow(10, 0.75), before_m, after_m);
    CHECK(paths.depth[i] == 1);
    CHECK(paths.vertex_interaction[paths.vertex_offset[i]] == target_point);
    CHECK(glm::distance(paths.vertex_position_m[paths.vertex_offset[i]], point) < 1e-12);
    CHECK(deviation(paths.delay_s[i], (before_m + after_m) / speed_of_light) < 1e-12);
    CHECK(deviation(std::norm(paths.a[i][0]), expected) < 1e-9);  // V to V, H to H, and across
    CHECK(deviation(std::norm(paths.a[i][3]), expected) < 1e-9);
    CHECK(deviation(std::norm(paths.a[i][1]), expected / 100) < 1e-9);
    CHECK(deviation(std::norm(paths.a[i][2]), expected / 100) < 1e-9);
    CHECK(paths.aod_phi_rad[i] == doctest::Approx(std::atan2(15, 39.5)).epsilon(1e-12));
  }
}

TEST_CASE("laws of 3GPP in many directions, turned targets, and the same on the way back") {
  const SceneFile file(far_plate);
  size_t compared = 0;
  for (const char* word : {"person", "person-aspects", "uav-small", "uav-large", "vehicle", "agv"}) {
    const TargetKind kind = TargetKind::named(word);
    const KindLaw& law = kind_law(kind);
    const std::array<double, 3> turned{40, 0, 0};
    const double c = std::cos(40 * pi / 180), s = std::sin(40 * pi / 180);
    Points ends;
    for (int i = 0; i < 13; ++i)
      ends.push_back(dvec3{30 * std::cos(0.9 * i), 25 * std::sin(0.9 * i), 3.1 * i - 14} + dvec3{0.3, 0.1, 0.2});
    Config config = radar_world(file, ends, ends, 1);
    TargetModelConfig model;
    model.kind = kind;
    add_target(config, model, {2, -1, 0.4}, turned);
    const dvec3 point = dvec3{2, -1, 0.4} + kind_points(kind, law.size_m)[0];
    const Paths paths = run(config).paths;
    std::map<std::pair<uint32_t, uint32_t>, size_t> rows;
    for (const size_t i : echoes(paths)) rows[{paths.tx[i], paths.rx[i]}] = i;
    CHECK(rows.size() == 13 * 13);  // receivers have names of their own
    for (const auto& [link, i] : rows) {
      const auto in_target = [&](const dvec3& p) {
        const dvec3 d = glm::normalize(p - point);
        return dvec3{c * d.x + s * d.y, -s * d.x + c * d.y, d.z};
      };
      const dvec3 a = in_target(ends[link.first]), b = in_target(ends[link.second]);
      const double expected =
          radar_gain(std::pow(10, section_db(law, nullptr, a, b) / 10), glm::distance(ends[link.first], point),
                     glm::distance(ends[link.second], point));
      CAPTURE(std::string(word));
      CAPTURE(link.first);
      CAPTURE(link.second);
      CHECK(deviation(std::norm(paths.a[i][0]), expected) < 1e-9);
      CHECK(deviation(std::norm(paths.a[i][1]), expected * std::pow(10, -law.xpr_db / 10)) < 1e-9);
      const auto& back = paths.a[rows.at({link.second, link.first})];
      const double size = std::abs(paths.a[i][0]);
      for (const auto& [p, q] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
        CHECK(std::abs(paths.a[i][p] - back[q]) < 1e-12 * size);
      ++compared;
    }
  }
  CHECK(compared == 6 * 13 * 13);
}

TEST_CASE("a vehicle of five points: each has its place, its lobe and its number") {
  const SceneFile file(far_plate);
  const dvec3 from{60, 8, 1}, to{55, -9, 2};
  Config config = radar_world(file, {from}, {to}, 1);
  TargetModelConfig other, model;
  other.rcs_dbsm = {0};
  add_target(config, other, {10, 30, 1});
  model.kind = "vehicle-points";
  model.size_m = {4.4, 1.9, 1.5};
  add_target(config, model, {0, 0, 0});
  const Paths paths = run(config).paths;
  const KindLaw& law = kind_law("vehicle-points");
  std::set<uint32_t> points;
  for (const size_t i : echoes(paths)) {
    if (paths.target[i] != 1) continue;
    const uint32_t number = paths.vertex_surface[paths.vertex_offset[i]];
    REQUIRE(number < 5);
    const dvec3 p = kind_points("vehicle-points", {4.4, 1.9, 1.5})[number];
    CHECK(points.insert(number).second);
    CHECK(glm::distance(paths.vertex_position_m[paths.vertex_offset[i]], p) < 1e-12);
    const double section = section_db(law, &law.lobes[number], glm::normalize(from - p), glm::normalize(to - p));
    CHECK(deviation(std::norm(paths.a[i][0]),
                    radar_gain(std::pow(10, section / 10), glm::distance(from, p), glm::distance(to, p))) < 1e-9);
  }
  CHECK(points.size() == 5);
  CHECK(echoes(paths).size() == 6);
}

TEST_CASE("custom lobes: the strongest counts, and points in one place are two paths") {
  const SceneFile file(far_plate);
  Config config = radar_world(file, {{50, 0, 0}}, {{50, 0, 0.0}}, 1);
  TargetModelConfig model;
  model.points_m = {{0, 0, 0}, {0, 0, 0}};
  model.lobes = {{0, 10, 20, 90, 40, 12, 30}, {0, -90, 40, 90, 40, 20, 25}, {1, 0, 0, 0, 0, 3, 10}};
  add_target(config, model, {0, 0, 0});
  const Paths paths = run(config).paths;
  std::vector<double> sections;
  for (const size_t i : echoes(paths))
    sections.push_back(10 * std::log10(std::norm(paths.a[i][0]) / radar_gain(1, 50, 50)));
  REQUIRE(sections.size() == 2);
  std::ranges::sort(sections);
  CHECK(sections[0] == doctest::Approx(3).epsilon(1e-9));
  CHECK(sections[1] == doctest::Approx(12 - 12 * 0.25).epsilon(1e-9));  // 12 (10 / 20)^2
}

TEST_CASE("one mirror before and after the target: the images of both antennas") {
  MaterialConfig mirror;
  mirror.name = "metal";
  mirror.permittivity = 1;
  mirror.conductivity_s_m = 1e18;
  const SceneFile file(std::vector<Quad>{{{0, -40, -40}, {0, 80, 0}, {0, 0, 80}}});  // x = 0
  const dvec3 from{3.1, -1.2, 2.2}, to{2.4, 0.7, 5.3}, point{6.3, 2.8, 1.6}, image{-1, 1, 1};
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  for (const bool together : {false, true}) {
    const dvec3 receiver = together ? from : to;
    Config config = radar_world(file, {from}, {receiver}, 4);
    config.materials = {mirror};
    add_target(config, model, point);
    CHECK(echoes(run(config).paths).size() == 1);  // without reflections
    for (const char* discovery : {"beams", "rays"}) {
      config.trace.discovery = DiscoveryWay::named(discovery);
      config.trace.target_reflections = 2;
      const Paths paths = run(config).paths;
      std::multimap<std::string, size_t> rows;
      for (const size_t i : echoes(paths)) {
        std::string kind;
        for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
          kind += paths.vertex_interaction[k] == target_point ? 'T' : 'R';
        rows.emplace(kind, i);
      }
      CAPTURE(together);
      CAPTURE(std::string(discovery));
      CHECK(rows.size() == 4);
      for (const std::string kind : {"T", "RT", "TR", "RTR"}) {
        CAPTURE(kind);
        REQUIRE(rows.count(kind) == 1);
        const size_t i = rows.find(kind)->second;
        const double before_m = glm::distance(kind.front() == 'R' ? from * image : from, point);
        const double after_m = glm::distance(kind.back() == 'R' ? receiver * image : receiver, point);
        CHECK(deviation(paths.delay_s[i], (before_m + after_m) / speed_of_light) < 1e-12);
        CHECK(deviation(std::norm(paths.a[i][0]), radar_gain(std::pow(10, 0.4), before_m, after_m)) < 1e-7);
      }
    }
    Config shallow = config;
    shallow.trace.max_depth = 2;
    CHECK(echoes(run(shallow).paths).size() == 3);  // RTR has three interactions
  }
}

TEST_CASE("walls hide targets, or are passed") {
  const SceneFile file(std::vector<Part>{{{{{20, -9, -9}, {0, 18, 0}, {0, 0, 18}}}, "glass"}});
  Config config = radar_world(file, {{0, 1, 0}}, {{0, -1, 0}}, 5);
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  add_target(config, model, {40, 0, 0});
  add_target(config, model, {10, 0, 0});
  CHECK(run(config).paths.target[echoes(run(config).paths)[0]] == 1);
  CHECK(echoes(run(config).paths).size() == 1);
  config.trace.transmission = true;
  const Paths paths = run(config).paths;
  std::vector<uint32_t> targets;
  for (const size_t i : echoes(paths)) {
    targets.push_back(paths.target[i]);
    CHECK(paths.depth[i] == (paths.target[i] == 0 ? 3 : 1));
  }
  CHECK(targets == std::vector<uint32_t>{1, 0});
}

TEST_CASE("without targets nothing changes; sums of links count what the paths say") {
  const SceneFile file(std::vector<Quad>{{{0, -40, -40}, {0, 80, 0}, {0, 0, 80}}});
  Config config = radar_world(file, {{3, 1, 1}}, {{4, -2, 2}}, 3);
  const FrameResult plain = run(config);
  CHECK(plain.paths.target.empty());
  CHECK(plain.seconds.count("targets") == 0);
  config.trace.target = false;
  CHECK(identical(run(config).paths, plain.paths));
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  add_target(config, model, {6, 1, 1});
  CHECK(identical(run(config).paths, plain.paths));
  config.trace.target = true;
  config.trace.target_reflections = 1;
  const FrameResult all = run(config);
  CHECK(all.paths.size() == plain.paths.size() + 4);
  config.trace.batch_receivers = 1;
  config.receivers.push_back({"rx9", {5, -3, 2}, "isotropic", "VH", {0, 0, 0}});
  const FrameResult batches = run(config);
  CHECK(batches.paths.target.size() == batches.paths.size());
  CHECK(echoes(batches.paths).size() == 8);
  Simulation summed(config);
  summed.sum_links(true);
  const FrameResult sums = summed.run_frame(0);
  REQUIRE(sums.summed);
  CHECK(sums.summed->kinds[5] == 8);
}

TEST_CASE("a floor leaves out weak paths over targets alone, with mirrors as well, and counts them") {
  const SceneFile file(
      std::vector<Quad>{{{0, -200, -40}, {0, 400, 0}, {0, 0, 80}}, {{-1, -200, -5}, {400, 0, 0}, {0, 400, 0}}});
  Config config = radar_world(file, {{3, 1, 1}, {50, -20, 2}}, {{4, -2, 2}, {90, 60, 3}}, 4);
  config.trace.target_reflections = 1;
  for (int i = 0; i < 24; ++i) {
    TargetModelConfig model;
    model.rcs_dbsm = {-10.0 + i};
    model.xpr_db = 12;
    add_target(config, model, {5 + 7.0 * i, 60 * std::sin(i), 0.5 + 0.1 * i});
  }
  const FrameResult all = run(config);
  CHECK(all.counts.weak == 0);
  constexpr double floor_db = -150;
  config.trace.target_floor_db = floor_db;
  const FrameResult some = run(config);
  const auto key = [](const Paths& paths, size_t i) {
    return std::tuple(paths.tx[i], paths.rx[i], paths.delay_s[i], paths.gain_db[i], paths.doppler_hz[i]);
  };
  std::set<std::tuple<uint32_t, uint32_t, double, double, double>> kept;
  for (size_t i = 0; i < some.paths.size(); ++i) kept.insert(key(some.paths, i));
  CHECK(kept.size() == some.paths.size());
  size_t left_out = 0, stays = 0, matched = 0;
  for (size_t i = 0; i < all.paths.size(); ++i) {
    const bool found = kept.contains(key(all.paths, i));
    matched += found;
    // Both ends have two ports, so the gain is the sum of four powers; a bound is that of one in each polarization.
    if (all.paths.target[i] == no_target || all.paths.gain_db[i] >= floor_db + 10 * std::log10(2)) {
      CHECK(found);
      ++stays;
    }
    left_out += !found;
  }
  CHECK(matched == some.paths.size());
  CHECK(stays > 50);
  CHECK(left_out > 100);
  CHECK(some.counts.weak > 0);
  CHECK(some.counts.weak <= left_out);
}
