// SPDX-License-Identifier: Apache-2.0
// Maps of samples by hand: means, deviations and shares of lists of gains, and what their files say.
#include "coverage/chance_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/file.hpp"
#include "coverage/grid_cells.hpp"
#include "coverage/write_map.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;

namespace {

constexpr double nothing = -INFINITY;

// Returns the links of a sample: two transmitters to receiver 0, which is no cell, and to the cells 0 and 1.
std::vector<LinkFigures> sample(const std::vector<double>& west_db, const std::vector<double>& east_db) {
  std::vector<LinkFigures> out;
  for (uint32_t tx = 0; tx < 2; ++tx) {
    out.push_back({.tx = tx, .rx = 0, .paths = 9, .path_gain_db = -1});
    for (uint32_t cell = 0; cell < 2; ++cell) {
      const double gain_db = (tx == 0 ? west_db : east_db)[cell];
      out.push_back({.tx = tx, .rx = cell + 1, .paths = std::isfinite(gain_db) ? 1u : 0u, .path_gain_db = gain_db});
    }
  }
  return out;
}

ChanceMap made(const std::vector<std::string>& thresholds, std::optional<uint32_t> tx = {}) {
  Map map{.grid = "g", .columns = 2, .rows = 1, .first_m = {0, 0}, .step_m = {1, 1}, .z_m = {1, 1}, .tx = tx};
  map.transmitters = {"west", "east"};
  map.thresholds = read_thresholds(thresholds, "--threshold");
  return {map, {no_cell, 0, 1}, {.transmit_power_dbm = 30, .bandwidth_hz = 1e7}};
}

// West has gains of -80, -82, -87 and none in cell 0, east has -90 always; cell 1 has one path in one sample.
Map four_samples(const std::vector<std::string>& thresholds, std::optional<uint32_t> tx = {}) {
  ChanceMap chances = made(thresholds, tx);
  chances.set_nominal(sample({-81, nothing}, {-90, nothing}));
  chances.add_sample(sample({-80, nothing}, {-90, nothing}));
  chances.add_sample(sample({-82, nothing}, {-90, -100}));
  chances.add_sample(sample({-87, nothing}, {-90, nothing}));
  chances.add_sample(sample({nothing, nothing}, {-90, nothing}));
  return chances.finish();
}

}  // namespace

TEST_CASE("a cell has the mean, the deviation and the shares of its strongest transmitters, sample by sample") {
  const Map map = four_samples({"received_dbm=-52", "path_gain_db=-87", "sinr_db=5"});
  CHECK(map.samples == 4);
  const Chances &first = map.chances[0], &second = map.chances[1];
  CHECK(first.samples == 4);
  CHECK(first.path_gain_mean_db == doctest::Approx(-84.75));  // the strongest have -80, -82, -87 and -90
  CHECK(first.path_gain_deviation_db ==
        doctest::Approx(std::sqrt((4.75 * 4.75 + 2.75 * 2.75 + 2.25 * 2.25 + 5.25 * 5.25) / 3)));
  CHECK(first.received == 0.5);    // -82 reaches it
  CHECK(first.path_gain == 0.75);  // -87 reaches it
  // The noise is -104 dBm, so east alone disturbs: 10, 8 and 3 dB below west, and nobody disturbs east.
  CHECK(first.sinr == 0.75);
  CHECK(second.samples == 1);
  CHECK(second.path_gain_mean_db == -100);
  CHECK(std::isnan(second.path_gain_deviation_db));
  CHECK(second.path_gain == 0);
  CHECK(map.cells[0].path_gain_db == -81);
  CHECK(map.cells[0].best_server == 0);
  CHECK(map.reached(0));
  CHECK_FALSE(map.reached(1));
  std::vector<std::string_view> names;
  for (const LayerKind* layer : map.layers) names.push_back(layer->name);
  CHECK(names == std::vector<std::string_view>{"path_gain_db", "path_gain_mean_db", "path_gain_deviation_db", "samples",
                                               "path_gain_probability", "received_probability", "sinr_probability"});
}

TEST_CASE("a transmitter that was named serves all samples, and one without a path reaches nothing") {
  const Map map = four_samples({"path_gain_db=-100"}, 0);
  CHECK(map.chances[0].samples == 3);
  CHECK(map.chances[0].path_gain_mean_db == doctest::Approx(-83));
  CHECK(map.chances[0].path_gain == 0.75);
  CHECK(map.chances[1].samples == 0);
  CHECK(std::isnan(map.chances[1].path_gain_mean_db));
  CHECK(map.chances[1].path_gain == 0);
}

TEST_CASE("equal samples deviate by nothing, however weak or many they are") {
  ChanceMap chances = made({});
  chances.set_nominal(sample({-123.456789, nothing}, {nothing, nothing}));
  for (int k = 0; k < 1000; ++k) chances.add_sample(sample({-123.456789, nothing}, {nothing, nothing}));
  const Map map = chances.finish();
  CHECK(map.chances[0].path_gain_mean_db == -123.456789);
  CHECK(map.chances[0].path_gain_deviation_db == 0);
}

TEST_CASE("files of chances have their layers, thresholds and samples; a probability has colours from 0 to 1") {
  const test::TemporaryFolder folder;
  const std::vector<Map> maps = {four_samples({"received_dbm=-52"})};
  write_maps({maps, false, {"csv", "png", "geotiff"}}, folder.path() / "maps");
  const std::string csv = read_file(folder.path() / "maps/coverage.csv");
  CHECK(
      csv.starts_with("ix,iy,x_m,y_m,z_m,path_gain_db,path_gain_mean_db,path_gain_deviation_db,samples,"
                      "received_probability,tx\n0,0,0,0,1,-81,-84.75,"));
  CHECK(csv.ends_with(",4,0.5,west\n1,0,1,0,1,nan,-100,nan,1,0,\n"));
  const nlohmann::json about = nlohmann::json::parse(read_file(folder.path() / "maps/coverage.json"));
  CHECK(about["samples"] == 4);
  CHECK(about["layers"]["received_probability"]["at_least"] == nlohmann::json{{"received_dbm", -52}});
  CHECK(about["layers"]["received_probability"]["dark_to_bright"] == nlohmann::json{0, 1});
  CHECK_FALSE(about["layers"]["samples"].contains("at_least"));
  CHECK(read_file(folder.path() / "maps/received_probability.png").size() > 100);
  CHECK(read_file(folder.path() / "maps/received_probability.tif").find("probability of the received power") !=
        std::string::npos);
}

TEST_CASE("thresholds are read from their texts, and others are refused") {
  const std::vector<Threshold> read = read_thresholds({"snr_db=-3.5", "path_gain_db=-1e2"}, "--threshold");
  REQUIRE(read.size() == 2);
  CHECK(read[0].layer->name == "snr_probability");
  CHECK(read[0].tested == &layer_kind("snr_db"));
  CHECK(read[0].least == -3.5);
  CHECK(read[1].least == -100);
  CHECK(tested_names() == std::vector<std::string>{"path_gain_db", "received_dbm", "snr_db", "sinr_db"});
  const auto refused = [](const std::vector<std::string>& texts, const char* words) {
    CHECK_THROWS_WITH_AS(read_thresholds(texts, "--threshold"), doctest::Contains(words), ConfigError);
  };
  for (const char* text : {"snr_db=", "snr_db", "snr_db=3 dB", "snr_db=nan", "snr_db=inf", "snr_db=0x3"})
    refused({text}, "is no number: give one in dB");
  refused({"snrdb=3"}, "\"snrdb\" has no threshold, it can be that of path_gain_db");
  refused({"margin_db=3"}, "\"margin_db\" has no threshold");
  refused({"=3"}, "\"\" has no threshold");
  refused({"snr_db=1", "snr_db=1"}, "snr_db has a threshold already: give each name once");
}
