// SPDX-License-Identifier: Apache-2.0
// trace.diffraction_floor_db: paths over edges below it may be left out, and no other ones.
#include <set>

#include "simulation/bends.hpp"
#include "simulation/town.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The link and the length of a path, then its interactions with their surfaces.
using Names = std::vector<std::tuple<uint32_t, uint32_t, int64_t>>;

Names names_of(const Paths& paths, size_t i) {
  Names out{{paths.tx[i], paths.rx[i], std::llround(paths.delay_s[i] * 1e15)}};
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
    out.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]);
  return out;
}

size_t edges_of(const Paths& paths, size_t i) {
  size_t count = 0;
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
    count += paths.vertex_interaction[k] == diffraction;
  return count;
}

// The largest gain of a path from one polarisation of the transmitter to one of the receiver.
double best_gain_db(const Paths& paths, size_t i) {
  double power = 0;
  for (const std::complex<double>& a : paths.a[i]) power = std::max(power, std::norm(a));
  return 10 * std::log10(power);
}

// The number of paths that the floor leaves out. All of them must be below it.
size_t left_out(Config config, double floor_db) {
  CAPTURE(floor_db);
  const Paths all = run(config).paths;
  config.trace.diffraction_floor_db = floor_db;
  const Paths some = run(config).paths;
  std::set<Names> kept;
  for (size_t i = 0; i < some.size(); ++i) kept.insert(names_of(some, i));
  CHECK(kept.size() == some.size());
  size_t found = 0, missing = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    if (kept.contains(names_of(all, i))) {
      ++found;
      continue;
    }
    ++missing;
    const size_t edges = edges_of(all, i);
    CHECK(edges >= 1);
    CHECK(edges <= 2);
    CHECK(best_gain_db(all, i) < floor_db);
  }
  CHECK(found == some.size());
  return missing;
}

Config with_edges(Config config, uint32_t edges) {
  config.trace.diffraction = true;
  config.trace.max_diffractions = edges;
  return config;
}

Points around(size_t count) {
  Points out;
  for (size_t i = 0; i < count; ++i) {
    const double turn = 2.399963 * static_cast<double>(i), away = 6.0 + 0.9 * static_cast<double>(i % 11);
    out.push_back({away * std::cos(turn), away * std::sin(turn), 0.4 + 0.83 * static_cast<double>(i % 7)});
  }
  return out;
}

}  // namespace

TEST_CASE("only paths below the floor are left out: a town") {
  const Config one = with_edges(small_town(20000, 3), 1), two = with_edges(small_town(2000, 3), 2);
  CHECK(left_out(one, -120) > 100);
  CHECK(left_out(two, -180) > 100);
  CHECK(left_out(two, -120) > 1000);
}

TEST_CASE("only paths below the floor are left out: screens, boxes, thin walls and roofs of one plane") {
  const std::vector<Quad> thin = ground + turned_box({-0.1, -5.2}, 0.11, 0.02, 9.7, 4.1);
  const std::vector<Quad> terrace =
      ground + turned_box({-6.2, -3.1}, 0, 4.3, 5.7, 5.2) + turned_box({-1.9, -3.1}, 0, 3.9, 5.7, 5.2);
  size_t missing = 0;
  for (const std::vector<Quad>& quads : {screens(), two_boxes(), thin, terrace})
    for (const char* material : {"metal", "concrete", "glass"})
      for (const bool passes : {false, true}) {
        CAPTURE(material);
        CAPTURE(passes);
        const SceneFile file({{quads, material}});
        Config config =
            with_edges(config_of(file.path(), {{-11, 2.3, 1.9}, {1.7, -9.4, 6.6}}, around(12), 20000, 3), 2);
        config.radio.frequency_hz = 3e9;
        config.trace.transmission = passes;
        for (const double floor_db : {-105.0, -90.0}) missing += left_out(config, floor_db);
      }
  CHECK(missing > 3000);
}

TEST_CASE("paths over three edges and more, and those without any, have no floor") {
  Config config = with_edges(small_town(2000, 3), 1);
  config.trace.diffraction_floor_db = 0;
  const Paths lit = run(config).paths;
  for (size_t i = 0; i < lit.size(); ++i) CHECK(edges_of(lit, i) == 0);
  config.trace.max_diffractions = 4;
  const Paths some = run(config).paths;
  config.trace.diffraction_floor_db.reset();
  const Paths all = run(config).paths;
  const auto without_floor = [](const Paths& paths) {
    std::set<Names> out;
    for (size_t i = 0; i < paths.size(); ++i)
      if (edges_of(paths, i) == 0 || edges_of(paths, i) > 2) out.insert(names_of(paths, i));
    return out;
  };
  CHECK(without_floor(some) == without_floor(all));
  CHECK(without_floor(all).size() > lit.size());
  CHECK(some.size() < all.size());
}
