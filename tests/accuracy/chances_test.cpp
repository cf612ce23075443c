// SPDX-License-Identifier: Apache-2.0
// Maps of samples of the inputs in free space, where a gain is that of a distance, and over ground, where a sample is a
// run of its own; then the program. Cases that need a device are skipped with a message if there is none.
#include "accuracy/chances.hpp"

#include <nlohmann/json.hpp>

#include "accuracy/latin_hypercube.hpp"
#include "app/program.hpp"
#include "radio/constants.hpp"
#include "simulation/run.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double carrier_hz = 5.9e9, cell_height_m = 1.5;

std::string antenna(const std::string& name, const glm::dvec3& at) {
  return fmt::format("[[transmitter]]\nname = \"{}\"\nposition_m = [{}, {}, {}]\n", name, at.x, at.y, at.z);
}

std::string grid(const std::string& name, double x_min_m, double x_max_m, double step_m) {
  return fmt::format(
      "[[receiver_grid]]\nname = \"{}\"\nx_min_m = {}\nx_max_m = {}\ny_min_m = -1.0\ny_max_m = 1.0\nstep_m = {}\n"
      "height_m = {}\nabove = \"zero\"\n",
      name, x_min_m, x_max_m, step_m, cell_height_m);
}

std::string head(const SceneFile& scene, const std::string& trace) {
  return fmt::format(
      "scene.file = \"{}\"\n[radio]\nfrequency_hz = {}\ntransmit_power_dbm = 20.0\nbandwidth_hz = 1e7\n{}",
      scene.path().string(), carrier_hz, "[trace]\n" + trace);
}

// A small surface that is far away, so that all is free space.
SceneFile free_space() { return SceneFile({Quad{{-900, -900, -400}, {2, 0, 0}, {0, 2, 0}}}); }

accuracy::ChanceStudy studied(const std::string& file, std::vector<std::string> thresholds, uint32_t samples,
                              const accuracy::InputErrors& errors, std::vector<std::string> sets = {}) {
  const accuracy::ChanceRequest request{
      .inputs = {.file = file, .sets = std::move(sets), .device = "", .samples = samples, .seed = 7, .errors = errors},
      .thresholds = std::move(thresholds),
      .grid = "",
      .tx = ""};
  return accuracy::study_chances(request, {[](const std::string&) {}, [] { return false; }});
}

double gain_db(double distance_m) {
  return 20 * std::log10(speed_of_light_m_s / carrier_hz / (4 * std::acos(-1.0) * distance_m));
}

// Returns the probability of a standard normal number to be below x.
double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::pow(value - mean_of(values), 2);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double share_from(const std::vector<double>& values, double least) {
  return static_cast<double>(std::ranges::count_if(values, [&](double value) { return value >= least; })) /
         static_cast<double>(values.size());
}

std::string drive_file(const Folder& folder, const SceneFile& scene) {
  return folder.file(
      "drive.toml",
      head(scene, "max_depth = 0\nrays = 10\n") + grid("g", 0, 10, 2) +
          "[[track]]\nid = \"car\"\nwaypoints = [[0, 2, 6, 0], [1, 22, 6, 0]]\n[[mount]]\nname = \"roof\"\n"
          "role = \"transmitter\"\noffset_m = [0, 0, 1.6]\n");
}

// Runs the program for maps of six samples in each of two frames, with more options.
Outcome chances_of(const std::string& file, const std::string& out, std::vector<std::string> more) {
  const std::vector<std::string> command = {"accuracy", "--inputs",  "-c", file,       "-o",
                                            out,        "--samples", "6",  "--frames", "2"};
  more.insert(more.begin(), command.begin(), command.end());
  return run_program(more);
}

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

TEST_CASE("the program writes maps of chances for the frames of a drive") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const std::string file = drive_file(folder, scene), out = folder.path("out/new");
  const Outcome done =
      chances_of(file, out, {"--threshold", "received_dbm=-35", "--vehicles", "3", "--format", "csv,npy,png"});
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(contains(done.out, "received power of -35 dBm or more: "));
  const std::string csv = contents(out + "/coverage/coverage.csv");
  CHECK(
      csv.starts_with("frame,time_s,ix,iy,x_m,y_m,z_m,path_gain_db,path_gain_mean_db,path_gain_deviation_db,samples,"
                      "received_probability,tx\n"));
  CHECK(std::ranges::count(csv, '\n') == 1 + 2 * 5);
  const nlohmann::json about = nlohmann::json::parse(contents(out + "/coverage/coverage.json"));
  CHECK(about["samples"] == 6);
  CHECK(about["layers"]["received_probability"]["at_least"] == nlohmann::json{{"received_dbm", -35}});
  CHECK(about["layers"]["received_probability"]["dark_to_bright"] == nlohmann::json{0, 1});
  CHECK(contains(about["notes"][0].get<std::string>(), "6 samples of the inputs with seed 1; standard deviations: "));
  CHECK(contains(about["notes"][0].get<std::string>(), "vehicles 3 m"));
}

TEST_CASE("the program says what maps of chances need") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const std::string file = drive_file(folder, scene), out = folder.path("out");
  const auto refused = [&](std::vector<std::string> more, const std::string& words) {
    const Outcome outcome = chances_of(file, out, std::move(more));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, words));
  };
  refused({"--threshold", "received=-35"},
          "\"received\" has no threshold, it can be that of path_gain_db, received_dbm");
  refused({"--threshold", "snr_db=many"}, "\"many\" is no number: give one in dB");
  refused({"--threshold", "snr_db=1", "--threshold", "snr_db=2"}, "snr_db has a threshold already");
  refused({"--threshold", "snr_db=1", "--tx", "nobody"}, "--tx \"nobody\" is not the name of a transmitter");
  refused({"--threshold", "snr_db=1", "--discover-every", "2"}, "--discover-every excludes --threshold");
  refused({"--grid", "g"}, "--grid requires --threshold");
  refused({"--threshold", "snr_db=1", "--set", "trace.reception=\"sphere\""}, "cannot be summed on the device");
  refused({"--threshold", "snr_db=1", "--format", "gif"}, "--format \"gif\" is no format of a map");
  const auto other = [&](const std::string& text, const std::string& threshold, const std::string& words) {
    const std::string name = folder.file("other.toml", text);
    const Outcome outcome = run_program({"accuracy", "--inputs", "-c", name, "-o", out, "--threshold", threshold});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, words));
  };
  const std::string bare = fmt::format("scene.file = \"{}\"\n", scene.path().string());
  other(bare + antenna("a", {0, 0, 9}) + grid("g", 0, 4, 1), "received_dbm=-35",
        "--threshold received_dbm needs radio.transmit_power_dbm");
  other(bare + antenna("a", {0, 0, 9}) + "[[receiver]]\nname = \"b\"\nposition_m = [5, 0, 1]\n", "path_gain_db=-35",
        "has no [[receiver_grid]], whose cells --threshold needs: add one");
  other(bare + antenna("a", {0, 0, 9}) + grid("g", 0, 4, 1) + grid("h", 0, 4, 1), "path_gain_db=-35",
        "has 2 grids: name one with --grid, of g, h");
}
