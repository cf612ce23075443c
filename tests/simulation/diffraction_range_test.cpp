// SPDX-License-Identifier: Apache-2.0
// trace.diffraction_range_db: paths over edges that are that much weaker than the strongest path of their link without
// edges may be left out, no other ones, and what they have together is no more than the frame says.
#include <map>
#include <set>

#include "simulation/bends.hpp"
#include "simulation/town.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The link and the length of a path, then its interactions with their surfaces.
using PathName = std::vector<std::tuple<uint32_t, uint32_t, int64_t>>;

PathName name_of(const Paths& paths, size_t i) {
  PathName out{{paths.tx[i], paths.rx[i], std::llround(paths.delay_s[i] * 1e15)}};
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
    out.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]);
  return out;
}

size_t bends_of(const Paths& paths, size_t i) {
  size_t count = 0;
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
    count += paths.vertex_interaction[k] == diffraction;
  return count;
}

double power_of(const Paths& paths, size_t i) {
  double power = 0;
  for (const std::complex<double>& a : paths.a[i]) power += std::norm(a);
  return power;
}

// The strongest path of each link without edges.
std::map<Link, double> strongest_unbent(const Paths& paths) {
  std::map<Link, double> out;
  for (size_t i = 0; i < paths.size(); ++i)
    if (bends_of(paths, i) == 0) {
      double& most = out[{paths.tx[i], paths.rx[i]}];
      most = std::max(most, power_of(paths, i));
    }
  return out;
}

// The number of paths that the range leaves out of all those of the configuration. They must be below it, and no link
// may lack more than the frame says.
size_t left_out(Config config, const Paths& all, double range_db) {
  CAPTURE(range_db);
  config.trace.diffraction_range_db = range_db;
  const FrameResult frame = run(config);
  std::set<PathName> kept;
  for (size_t i = 0; i < frame.paths.size(); ++i) kept.insert(name_of(frame.paths, i));
  const std::map<Link, double> strongest = strongest_unbent(all);
  std::map<Link, double> lacking;
  size_t found = 0, missing = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    if (kept.contains(name_of(all, i))) {
      ++found;
      continue;
    }
    ++missing;
    const Link link{all.tx[i], all.rx[i]};
    CHECK(bends_of(all, i) >= 1);
    CHECK(bends_of(all, i) <= 2);
    REQUIRE(strongest.contains(link));
    CHECK(10 * std::log10(power_of(all, i) / strongest.at(link)) < -range_db);
    lacking[link] += power_of(all, i) / strongest.at(link);
  }
  CHECK(found == frame.paths.size());
  for (const auto& [link, share] : lacking) CHECK(share <= frame.left_out_at_edges);
  return missing;
}

size_t left_out(const Config& config, double range_db) { return left_out(config, run(config).paths, range_db); }

Config bending(Config config, uint32_t edges) {
  config.trace.diffraction = true;
  config.trace.max_diffractions = edges;
  return config;
}

Points circle_of(size_t count) {
  Points out;
  for (size_t i = 0; i < count; ++i) {
    const double turn = 2.399963 * static_cast<double>(i), away = 6.0 + 0.9 * static_cast<double>(i % 11);
    out.push_back({away * std::cos(turn), away * std::sin(turn), 0.4 + 0.83 * static_cast<double>(i % 7)});
  }
  return out;
}

}  // namespace

TEST_CASE("only paths below the range of their link are left out: a town, antennas of all kinds") {
  for (const char* antenna : {"dipole", "tr38901"}) {
    CAPTURE(antenna);
    Config config = bending(small_town(3000, 3), 1);
    for (RadioEnd& end : config.transmitters) end.antenna = antenna, end.polarization = "VH";
    config.receivers[1].antenna = antenna;
    config.receivers[1].orientation_deg = {70, 10, 0};
    const Paths all = run(config).paths;
    CHECK(left_out(config, all, 40) > 100);
    CHECK(left_out(config, all, 60) > 10);
  }
  CHECK(left_out(bending(small_town(1000, 3), 2), 50) > 1000);
}

TEST_CASE("only paths below the range of their link are left out: vehicles that hear each other") {
  Config config = bending(small_town(5000, 2), 1);
  config.receivers.clear();
  config.trajectories.generate = "--seed 1 --vehicles 6 --seconds 1 --step 0.1";
  for (const char* type : {"passenger", "delivery", "truck"})
    config.mounts.push_back({.name = "roof", .on = type, .role = "both", .offset_m = {0, 0, 2}, .antenna = "tr38901"});
  config.time.step_s = 0.1;
  CHECK(left_out(config, 40) > 10);
}

TEST_CASE("only paths below the range of their link are left out: screens and boxes, walls that pass waves") {
  size_t missing = 0;
  for (const std::vector<Quad>& quads : {screens(), two_boxes()})
    for (const char* material : {"metal", "glass"})
      for (const bool passes : {false, true}) {
        CAPTURE(material);
        CAPTURE(passes);
        const SceneFile file({{quads, material}});
        Config config =
            bending(config_of(file.path(), {{-11, 2.3, 1.9}, {1.7, -9.4, 6.6}}, circle_of(12), 10000, 3), 2);
        config.radio.frequency_hz = 3e9;
        config.trace.transmission = passes;
        const Paths all = run(config).paths;
        for (const double range_db : {30.0, 45.0}) missing += left_out(config, all, range_db);
      }
  CHECK(missing > 1000);
}

TEST_CASE("sums of links lack no more than the frame says, and frames of paths lack none unless it is asked for") {
  const SceneFile file({{two_boxes(), "concrete"}});
  Config config = map_over_boxes(file, 20000, 3, 1);
  config.output.paths = false;
  CHECK(Simulation(config).diffraction_range_db() == 45);
  Config whole = config;
  whole.trace.diffraction_range_db = 400;
  CHECK(Simulation(whole).diffraction_range_db() == 0);
  CHECK(identical(run(config).paths, run(whole).paths));
  CHECK(run(config).left_out_at_edges == 0);
  const auto sums = [](const Config& of) {
    Simulation simulation(of);
    simulation.sum_links(true);
    return simulation.run_frame(0);
  };
  const FrameResult some = sums(config), all = sums(whole);
  REQUIRE(some.summed);
  REQUIRE(all.summed);
  REQUIRE(some.summed->links.size() == all.summed->links.size());
  CHECK(some.counts.paths < all.counts.paths);
  CHECK(all.left_out_at_edges == 0);
  CHECK(some.left_out_at_edges > 0);
  CHECK(some.left_out_at_edges < 0.03);
  for (size_t i = 0; i < all.summed->links.size(); ++i) {
    const auto power_in = [i](const FrameResult& frame) {
      return std::pow(10.0, frame.summed->links[i].sum_of_powers_db / 10);
    };
    const double power = power_in(all), now = power_in(some);
    CHECK(now <= power * (1 + 1e-12));
    CHECK(now * (1 + some.left_out_at_edges) >= power * (1 - 1e-12));
  }
}
