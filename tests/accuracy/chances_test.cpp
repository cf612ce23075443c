// SPDX-License-Identifier: Apache-2.0
// Maps of samples of the inputs in free space, where a gain is that of a distance, and over ground, where a sample is a
// run of its own. Cases that need a device are skipped with a message if there is none.
#include "accuracy/chances.hpp"

#include "accuracy/free_space.hpp"
#include "accuracy/latin_hypercube.hpp"
#include "simulation/run.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns the probability of a standard normal number to be below x.
double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

TEST_CASE("chances: a height that errs reaches a threshold as often as a normal number lies between two") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const std::string file = folder.file(
      "free.toml", head(scene, "max_depth = 0\nrays = 10\n") + antenna("mast", {0, 0, 10}) + grid("g", 4, 36, 2));
  constexpr uint32_t samples = 500;
  constexpr double reach_m = 20, deviation_m = 3;
  const std::vector<std::string> thresholds = {fmt::format("path_gain_db={}", gain_db(reach_m)),
                                               fmt::format("received_dbm={}", 20 + gain_db(reach_m))};
  const accuracy::ChanceStudy study = studied(file, thresholds, samples, {0, deviation_m, 0, 0});
  REQUIRE(study.maps.size() == 1);
  const coverage::Map& map = study.maps[0];
  REQUIRE(map.columns == 16);
  REQUIRE(map.rows == 1);
  CHECK(study.varied == std::array<bool, 4>{false, true, false, false});
  size_t between = 0;  // cells that are neither sure nor hopeless
  for (size_t k = 0; k < map.columns; ++k) {
    const double across_m = 5 + 2.0 * static_cast<double>(k);
    CAPTURE(across_m);
    CHECK(map.x_m(k) == doctest::Approx(across_m));
    CHECK(map.z_m[k] == doctest::Approx(cell_height_m));
    CHECK(map.cells[k].path_gain_db == doctest::Approx(gain_db(std::hypot(across_m, 10 - cell_height_m))));
    // The mast is heard where its height is within `half` of that of the cell.
    const double half = across_m < reach_m ? std::sqrt(reach_m * reach_m - across_m * across_m) : 0;
    const double wanted = across_m < reach_m ? below((cell_height_m + half - 10) / deviation_m) -
                                                   below((cell_height_m - half - 10) / deviation_m)
                                             : 0;
    // A Latin hypercube has one sample in each part of 1 / samples, so each border errs by one sample at most.
    CHECK(std::abs(map.chances[k].path_gain - wanted) <= 2.0 / samples);
    CHECK(map.chances[k].received == map.chances[k].path_gain);
    CHECK(map.chances[k].samples == samples);
    between += wanted > 0.05 && wanted < 0.95;
  }
  CHECK(between >= 3);
  CHECK(std::isnan(map.chances[0].snr));  // without a threshold
}

TEST_CASE("chances: without errors a cell reaches the threshold always or never, and deviates by nothing") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const std::string file = folder.file(
      "free.toml", head(scene, "max_depth = 0\nrays = 10\n") + antenna("mast", {0, 0, 10}) + grid("g", 4, 36, 2));
  const coverage::Map map = studied(file, {fmt::format("path_gain_db={}", gain_db(20))}, 3, {0, 0, 0, 0}).maps.at(0);
  for (size_t k = 0; k < map.columns; ++k) {
    const double distance_m = std::hypot(5 + 2.0 * static_cast<double>(k), 10 - cell_height_m);
    CHECK(map.chances[k].path_gain == (distance_m <= 20 ? 1 : 0));
    CHECK(map.chances[k].path_gain_deviation_db == 0);
    CHECK(map.chances[k].path_gain_mean_db == map.cells[k].path_gain_db);
  }
}

TEST_CASE("chances: two transmitters in free space have in each sample the powers of their distances") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const std::array<glm::dvec3, 2> masts = {{{-20, 3, 10}, {60, -2, 8}}};
  const std::string file =
      folder.file("two.toml", head(scene, "max_depth = 0\nrays = 10\n") + antenna("west", masts[0]) +
                                  antenna("east", masts[1]) + grid("g", 0, 40, 5));
  constexpr uint32_t samples = 40;
  constexpr double snr_db = 40, sinr_db = 2;
  const accuracy::InputErrors errors{4, 2, 0, 0};
  const std::vector<std::string> thresholds = {fmt::format("snr_db={}", snr_db), fmt::format("sinr_db={}", sinr_db)};
  const coverage::Map map = studied(file, thresholds, samples, errors).maps.at(0);
  const auto rows = accuracy::normal_hypercube(samples, 6 + 1, 7);  // three columns a mast, and one material
  const double noise_mw = 1.380649e-23 * 290 * 1e7 * 1e3;
  REQUIRE(map.columns == 8);
  bool uncertain = false;
  for (size_t k = 0; k < map.columns; ++k) {
    const glm::dvec3 cell{2.5 + 5.0 * static_cast<double>(k), 0, cell_height_m};
    std::vector<double> gains, snr, sinr;
    for (const std::vector<double>& row : rows) {
      std::array<double, 2> power{};
      for (size_t i = 0; i < 2; ++i) {
        const glm::dvec3 at = masts[i] + glm::dvec3(4 * row[3 * i], 4 * row[3 * i + 1], 2 * row[3 * i + 2]);
        power[i] = std::pow(10, gain_db(glm::distance(at, cell)) / 10);
      }
      const auto [other, server] = std::minmax(power[0], power[1]);
      gains.push_back(10 * std::log10(server));
      snr.push_back(10 * std::log10(100 * server / noise_mw));
      sinr.push_back(10 * std::log10(100 * server / (noise_mw + 100 * other)));
    }
    CAPTURE(k);
    CHECK(map.chances[k].path_gain_mean_db == doctest::Approx(mean_of(gains)).epsilon(1e-9));
    CHECK(map.chances[k].path_gain_deviation_db == doctest::Approx(deviation_of(gains)).epsilon(1e-6));
    CHECK(map.chances[k].snr == share_from(snr, snr_db));
    CHECK(map.chances[k].sinr == share_from(sinr, sinr_db));
    uncertain = uncertain || (map.chances[k].sinr > 0.1 && map.chances[k].sinr < 0.9);
  }
  CHECK(uncertain);
  // Batches of receivers make the same map.
  const coverage::Map cut = studied(file, thresholds, samples, errors, {"trace.batch_receivers=3"}).maps.at(0);
  for (size_t k = 0; k < map.columns; ++k) {
    CHECK(cut.chances[k].path_gain_mean_db == map.chances[k].path_gain_mean_db);
    CHECK(cut.chances[k].sinr == map.chances[k].sinr);
  }
}

TEST_CASE("chances: over ground a sample is a run with the antenna and the permittivity of that sample") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene(std::vector<Part>{{{Quad{{-50, -50, 0}, {200, 0, 0}, {0, 100, 0}}}, "stone"}});
  const auto text = [&](const glm::dvec3& at, double permittivity) {
    return head(scene, "max_depth = 1\nrays = 20000\n") +
           fmt::format("[[material]]\nname = \"stone\"\npermittivity = {}\nthickness_m = inf\n", permittivity) +
           antenna("mast", at) + grid("g", 10, 40, 5);
  };
  const glm::dvec3 mast{0, 0, 10};
  const std::string file = folder.file("ground.toml", text(mast, 5));
  const accuracy::InputErrors errors{2, 0.5, 0.3, 0};
  const coverage::Map map = studied(file, {"path_gain_db=-75"}, 3, errors).maps.at(0);
  std::vector<std::vector<double>> gains(map.columns);
  for (const std::vector<double>& row : accuracy::normal_hypercube(3, 3 + 1, 7)) {
    const glm::dvec3 at = mast + glm::dvec3(2 * row[0], 2 * row[1], 0.5 * row[2]);
    Simulation simulation(load_config(folder.file("at.toml", text(at, 1 + 4 * std::exp(0.3 * row[3])))));
    simulation.sum_links(true);
    const FrameResult result = simulation.run_frame(0);
    REQUIRE(result.summed->links.size() == map.columns);
    for (size_t k = 0; k < map.columns; ++k) {
      CHECK(result.summed->links[k].paths == 2);
      gains[k].push_back(result.summed->links[k].path_gain_db);
    }
  }
  for (size_t k = 0; k < map.columns; ++k) {
    CHECK(map.chances[k].path_gain_mean_db == doctest::Approx(mean_of(gains[k])).epsilon(1e-9));
    CHECK(map.chances[k].path_gain_deviation_db == doctest::Approx(deviation_of(gains[k])).epsilon(1e-6));
    CHECK(map.chances[k].path_gain == share_from(gains[k], -75));
  }
}

TEST_CASE("chances: a sample of a ground of layers is a run with the permittivity of each layer in that sample") {
  if (!device_present()) return;
  const Folder folder;
  for (const bool turned : {false, true}) {  // the layers then begin above the ground, or below it
    const glm::dvec3 first(200, 0, 0), second(0, 100, 0);
    const SceneFile scene(
        std::vector<Part>{{{Quad{{-50, -50, 0}, turned ? second : first, turned ? first : second}}, "ground"}});
    const auto text = [&](double sand, double stone) {  // factors of an error
      const auto table = [](const char* name, double permittivity, double factor) {
        return fmt::format("[[material]]\nname = \"{}\"\npermittivity = {}\nconductivity_s_m = {}\n", name,
                           1 + (permittivity - 1) * factor, 0.01 * factor);
      };
      return head(scene, "max_depth = 1\nrays = 20000\n") + table("sand", 3, sand) + table("stone", 5, stone) +
             "[[material]]\nname = \"ground\"\nlayers = [{ material = \"sand\", thickness_m = 0.02 }, "
             "{ material = \"stone\", thickness_m = 0.05 }]\n" +
             antenna("mast", {0, 0, 10}) + grid("g", 10, 40, 5);
    };
    const coverage::Map map =
        studied(folder.file("layers.toml", text(1, 1)), {"path_gain_db=-75"}, 3, {0, 0, 0.1, 0}).maps.at(0);
    std::vector<std::vector<double>> gains(map.columns);
    // Three columns of the mast, then the ground, its two layers, and the ground for surfaces that are turned.
    for (const std::vector<double>& row : accuracy::normal_hypercube(3, 3 + 4, 7)) {
      const std::string at = text(std::exp(0.1 * row[4]), std::exp(0.1 * row[5]));
      Simulation simulation(load_config(folder.file("at.toml", at)));
      simulation.sum_links(true);
      const FrameResult result = simulation.run_frame(0);
      REQUIRE(result.summed->links.size() == map.columns);
      for (size_t k = 0; k < map.columns; ++k) gains[k].push_back(result.summed->links[k].path_gain_db);
    }
    for (size_t k = 0; k < map.columns; ++k) {
      CHECK(map.chances[k].path_gain_mean_db == doctest::Approx(mean_of(gains[k])).epsilon(1e-9));
      CHECK(map.chances[k].path_gain_deviation_db == doctest::Approx(deviation_of(gains[k])).epsilon(1e-6));
    }
  }
}
