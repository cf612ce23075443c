// SPDX-License-Identifier: Apache-2.0
// The comparison against reference lists, on lists whose outcome is known: the list itself, and the list with faults.
// Percentages of numpy.percentile are given as numbers computed by hand.
#include "reference/compare.hpp"
#include <doctest/doctest.h>
#include <unistd.h>
#include <cmath>
#include <fstream>
#include "folders.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::reference;

namespace {

const std::filesystem::path lists_folder =
    std::filesystem::path(test::source_folder()) / "tests" / "reference" / "oracle";

// Copies path i of the list to its end.
void repeat_path(Paths& paths, size_t i) {
  paths.tx.push_back(paths.tx[i]);
  paths.rx.push_back(paths.rx[i]);
  paths.delay_s.push_back(paths.delay_s[i]);
  paths.a.push_back(paths.a[i]);
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
    paths.vertex_position_m.push_back(paths.vertex_position_m[k]);
    paths.vertex_interaction.push_back(paths.vertex_interaction[k]);
  }
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
}

}  // namespace

TEST_CASE("every list agrees with itself") {
  const std::pair<const char*, size_t> cases[] = {{"box_depth5", 461},
                                                  {"box_one_screen", 35},
                                                  {"simple_reflector", 2},
                                                  {"double_reflector", 4},
                                                  {"triple_reflector", 7},
                                                  {"floor_wall", 4},
                                                  {"simple_wedge", 4},
                                                  {"street_canyon_cars_specular", 136},
                                                  {"street_canyon_cars_all", 307}};
  for (const auto& [name, paths] : cases) {
    CAPTURE(name);
    const Case reference = load_case(lists_folder / (std::string(name) + ".json"));
    CHECK(reference.name == name);
    CHECK(reference.frequency_hz == 5.9e9);
    const Comparison result = compare_paths(reference, reference.paths);
    CHECK(result.reference == paths);
    CHECK(result.recall == 1);
    CHECK(result.power_recall == doctest::Approx(1).epsilon(1e-14));
    CHECK(result.extra == 0);
    CHECK(result.duplicates == 0);
    CHECK(result.delay_rel_err_max == 0);
    CHECK(result.gain_err_db_max < 1e-13);
    CHECK(result.matrix_rel_err_p99 == 0);
  }
}

TEST_CASE("the list of free space obeys Friis") {
  const Case reference = load_case(lists_folder / "simple_reflector.json");
  const double wavelength_m = 299792458.0 / 5.9e9, distance_m = 299792458.0 * reference.paths.delay_s[0];
  CHECK(reference.paths.depth[0] == 0);
  CHECK(std::abs(reference.paths.a[0][0]) == doctest::Approx(wavelength_m / (4 * M_PI * distance_m)).epsilon(1e-5));
}

TEST_CASE("missing paths lower recall, and power recall by their power") {
  const Case reference = load_case(lists_folder / "simple_reflector.json");
  Paths mine = reference.paths;
  mine.delay_s[0] *= 1 + 3e-5;  // line of sight, beyond both tolerances: 71 fs on 2.4 ns is not, 71 fs < 30 ps
  CHECK(compare_paths(reference, mine).found == 2);
  mine.delay_s[0] += 31e-12;
  const Comparison result = compare_paths(reference, mine);
  CHECK(result.found == 1);
  CHECK(result.recall == 0.5);
  CHECK(result.extra == 1);
  const double los = std::pow(10, reference.paths.gain_db[0] / 10),
               ground = std::pow(10, reference.paths.gain_db[1] / 10);
  CHECK(result.power_recall == doctest::Approx(ground / (los + ground)).epsilon(1e-12));
  CHECK(result.extra_power_ratio == doctest::Approx(los / (los + ground)).epsilon(1e-12));
}

TEST_CASE("a vertex may be off by 30 cm, not more") {
  const Case reference = load_case(lists_folder / "simple_reflector.json");
  Paths mine = reference.paths;
  mine.vertex_position_m[0].y += 0.29;
  CHECK(compare_paths(reference, mine).found == 2);
  mine.vertex_position_m[0].y += 0.02;
  CHECK(compare_paths(reference, mine).found == 1);
}

TEST_CASE("interactions and ends must agree") {
  const Case reference = load_case(lists_folder / "simple_reflector.json");
  Paths mine = reference.paths;
  mine.vertex_interaction[0] = transmission;
  CHECK(compare_paths(reference, mine).found == 1);
  mine.rx[0] = 1;
  CHECK(compare_paths(reference, mine).found == 0);
}

TEST_CASE("a repeated path is extra and a duplicate") {
  const Case reference = load_case(lists_folder / "triple_reflector.json");
  Paths mine = reference.paths;
  repeat_path(mine, 3);
  const Comparison result = compare_paths(reference, mine);
  CHECK(result.recall == 1);
  CHECK(result.extra == 1);
  CHECK(result.duplicates == 1);
}

TEST_CASE("errors of gain and matrix: 0.1 dB on one path of seven") {
  const Case reference = load_case(lists_folder / "triple_reflector.json");
  Paths mine = reference.paths;
  const double factor = std::pow(10, 0.1 / 20);
  for (auto& a : mine.a[2]) a *= factor;
  const Comparison result = compare_paths(reference, mine);
  CHECK(result.gain_err_db_max == doctest::Approx(0.1).epsilon(1e-9));
  CHECK(result.gain_err_db_p50 < 1e-12);
  CHECK(result.gain_err_db_p99 == doctest::Approx(0.094).epsilon(1e-9));  // rank 5.94 of 0 to 6
  CHECK(result.matrix_rel_err_p99 == doctest::Approx(0.94 * (factor - 1)).epsilon(1e-9));
}

TEST_CASE("single-port paths are matched, their gains are not compared") {
  const Case reference = load_case(lists_folder / "triple_reflector.json");
  Paths mine = reference.paths;
  mine.rx_ports = mine.tx_ports = 1;
  const Comparison result = compare_paths(reference, mine);
  CHECK(result.recall == 1);
  CHECK(std::isnan(result.gain_err_db_max));
}

TEST_CASE("kinds of path: counts, and faults that are told apart") {
  const Case reference = load_case(lists_folder / "street_canyon_cars_all.json");
  Paths mine = reference.paths;
  const Comparison same = compare_paths(reference, mine);
  REQUIRE(same.kinds.size() == 4);
  CHECK(same.kinds.at("specular").reference == 9);
  CHECK(same.kinds.at("transmission").reference == 2);
  CHECK(same.kinds.at("diffraction").reference == 294);
  CHECK(same.kinds.at("transmission + diffraction").reference == 2);
  CHECK(same.missing.empty());
  CHECK(same.extra_paths.empty());
  CHECK(to_string(same).find("\n  transmission + diffraction: found 2 of 2") != std::string::npos);

  // The first path is diffracted once: moved, it is missing and extra. One other of its kind gets 1 dB.
  mine.vertex_position_m[0].z += 1;
  size_t other = 1;
  while (mine.vertex_interaction[mine.vertex_offset[other]] != diffraction || mine.depth[other] != 1) ++other;
  for (auto& a : mine.a[other]) a *= std::pow(10, 1.0 / 20);
  const Comparison result = compare_paths(reference, mine);
  CHECK(result.missing == std::vector<size_t>{0});
  CHECK(result.extra_paths == std::vector<size_t>{0});
  const Agreement& diffracted = result.kinds.at("diffraction");
  CHECK(diffracted.found == 294 - 1);
  CHECK(diffracted.extra == 1);
  CHECK(diffracted.gain_err_db_max == doctest::Approx(1).epsilon(1e-9));
  CHECK(result.gain_err_db_max == diffracted.gain_err_db_max);
  for (const char* kind : {"specular", "transmission", "transmission + diffraction"}) {
    CHECK(result.kinds.at(kind).recall == 1);
    CHECK(result.kinds.at(kind).extra == 0);
    CHECK(result.kinds.at(kind).gain_err_db_max < 1e-12);
  }
  CHECK(to_string(reference.paths, 0) == "tx 0 rx 0, 276.7664 ns, -94.07 dB, diffraction (26.1118, 4.7000, 1.4920)");
}

TEST_CASE("no paths: recall 0, not a crash") {
  const Comparison result = compare_paths(lists_folder / "simple_wedge.json", Paths{});
  CHECK(result.recall == 0);
  CHECK(result.extra == 0);
  CHECK(std::isnan(result.delay_rel_err_max));
  CHECK(to_string(result).starts_with("found 0 of 4"));
}

TEST_CASE("a missing or broken list is an error that names it") {
  CHECK_THROWS_WITH_AS(load_case(lists_folder / "none.json"), doctest::Contains("none.json"), InputError);
  const std::filesystem::path broken =
      std::filesystem::temp_directory_path() / ("wavetracer-broken-" + std::to_string(getpid()) + ".json");
  std::ofstream(broken) << "{\"case\": 1}";
  CHECK_THROWS_WITH_AS(load_case(broken), doctest::Contains("is not a reference list"), InputError);
  std::filesystem::remove(broken);
}
