// SPDX-License-Identifier: Apache-2.0
// A reader finds the data that write_outputs() has written: paths.h5 through the C library, links.csv and summary.json.
// Leaves its sample under tests/output/sample of the build folder, for the tests that read it from Python.
#include "wavetracer/output.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include "folders.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/output.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::Reader;
using test::slurp;

namespace {

const fs::path folder = fs::path(test::build_folder()) / "tests" / "output" / "sample";

using Values = std::vector<double>;
using Shape = std::vector<hsize_t>;

}  // namespace

TEST_CASE("paths.h5 holds every column of every frame, in order") {
  fs::remove_all(folder);
  const SampleRun sample;
  const auto written = write_outputs(folder, sample.run(), sample.frames());
  REQUIRE(written == std::vector<fs::path>{folder / "paths.h5", folder / "links.csv", folder / "summary.json"});
  const Reader h5(written[0]);

  CHECK(h5.numbers("/paths/frame") == Values{7, 7, 7, 8, 8});
  CHECK(h5.numbers("/paths/tx") == Values{0, 0, 1, 0, 1});
  CHECK(h5.numbers("/paths/rx") == Values{0, 1, 0, 0, 1});
  CHECK(h5.numbers("/paths/depth") == Values{0, 1, 2, 3, 4});
  CHECK(h5.numbers("/paths/gain_db") == Values{-80, -81, -82, -83, -84});
  CHECK(h5.numbers("/paths/delay_s") == Values{1e-7, 2e-7, 1e-7 * 3, 1e-7 * 4, 1e-7 * 5});
  CHECK(h5.numbers("/paths/doppler_hz") == Values{0, 10, 20, 30, 40});
  CHECK(h5.numbers("/paths/aoa_phi_rad")[4] == -0.4 * 4);
  CHECK(h5.numbers("/paths/aod_theta_rad")[4] == 0.1 * 4);
  CHECK(h5.numbers("/paths/aod_phi_rad")[4] == 0.2 * 4);
  CHECK(h5.numbers("/paths/aoa_theta_rad")[3] == 0.3 * 3);
  CHECK(h5.shape("/paths/a_re") == Shape{5, 2, 1});
  const Values re = h5.numbers("/paths/a_re"), im = h5.numbers("/paths/a_im");
  for (size_t i = 0; i < 5; ++i) {
    CHECK(re[2 * i] == 1e-4 * static_cast<double>(i));
    CHECK(re[2 * i + 1] == 2e-4 * static_cast<double>(i));
    CHECK(im[2 * i] == 1);
    CHECK(im[2 * i + 1] == -1);
  }

  // Offsets run on across frames: depths 0, 1, 2 | 3, 4.
  CHECK(h5.numbers("/paths/vertex_offset") == Values{0, 0, 1, 3, 6, 10});
  CHECK(h5.shape("/vertices/position_m") == Shape{10, 3});
  const Values position = h5.numbers("/vertices/position_m");
  CHECK(position[3 * 9] == 1e6 + 4);
  CHECK(position[3 * 9 + 1] == 1.0);
  CHECK(position[3 * 5 + 1] == 2 / 3.0);
  CHECK(h5.numbers("/vertices/interaction") == Values{1, 1, 4, 1, 4, 1, 1, 4, 1, 4});
  CHECK(h5.numbers("/vertices/surface") == Values{100, 200, 201, 300, 301, 302, 400, 401, 402, 403});
  CHECK(h5.numbers("/vertices/instance")[0] == 4294967295.0);
  CHECK(h5.numbers("/frames/frame") == Values{7, 8});
  CHECK(h5.numbers("/frames/time_s") == Values{0, 0.1});
  CHECK(h5.numbers("/frames/path_offset") == Values{0, 3, 5});
  CHECK(h5.numbers("/transmitters/position_m") == Values{1, 2, 3, 4, 5, 6});
  CHECK(h5.numbers("/transmitters/orientation_deg") == Values{0, 0, 0, 90, 10, 0});
  CHECK(h5.numbers("/transmitters/velocity_m_s") == Values{0, 0, 0, 0, -3, 0.5});
  CHECK(h5.shape("/receivers/name") == Shape{2});

  CHECK(h5.attribute("/", "config") == sample.config.text);
  CHECK(h5.attribute("/", "version") == WAVETRACER_VERSION);
  CHECK(h5.attribute("/paths/delay_s", "units") == "s");
  CHECK(h5.attribute("/vertices/position_m", "units") == "m");
}

TEST_CASE("paths.h5 holds the world of every frame, in file coordinates") {
  const SampleRun sample;
  std::vector<FrameResult> frames = sample.frames();
  frames[0].world.receivers[1].present = false;
  const Reader h5(write_outputs(folder.parent_path() / "world", sample.run(), frames)[0]);
  CHECK(h5.shape("/frames/transmitter_position_m") == Shape{2, 2, 3});
  CHECK(h5.numbers("/frames/transmitter_position_m") == Values{1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6});
  CHECK(h5.numbers("/frames/transmitter_velocity_m_s") == Values{0, 0, 0, 0, -3, 0.5, 0, 0, 0, 0, -3, 0.5});
  const Values receivers = h5.numbers("/frames/receiver_position_m"),
               velocities = h5.numbers("/frames/receiver_velocity_m_s");
  CHECK(Values(receivers.begin(), receivers.begin() + 3) == Values{7, 8, 9});
  for (size_t i = 3; i < 6; ++i) {
    CHECK(std::isnan(receivers[i]));
    CHECK(std::isnan(velocities[i]));
  }
  CHECK(Values(receivers.begin() + 6, receivers.end()) == Values{7, 8, 9, 0, 0, 0});

  CHECK(h5.shape("/instances/id") == Shape{2});
  CHECK(h5.numbers("/poses/frame") == Values{7, 8, 8});
  CHECK(h5.numbers("/poses/instance") == Values{0, 0, 1});
  // The file's origin of the bus is half a metre behind and a metre below the recentred one; ahead is +y.
  CHECK(h5.numbers("/poses/position_m") == Values{513, -254, 3, 516, -254, 3, 522, -236.5, 1});
  // It turns to the left about the recentred origin, so what is behind swings to the right, +x.
  CHECK(h5.numbers("/poses/velocity_m_s") == Values{0, 0, 0, 0, 0, 0, 1, 8, 0});
  CHECK(h5.shape("/poses/rotation") == Shape{3, 3, 3});
  const Values rotation = h5.numbers("/poses/rotation");
  CHECK(Values(rotation.begin() + 18, rotation.end()) == Values{0, -1, 0, 1, 0, 0, 0, 0, 1});
  CHECK(h5.numbers("/links/frame") == Values{7, 7, 7, 7, 8, 8, 8, 8});
  CHECK(h5.numbers("/links/tx") == Values{0, 0, 1, 1, 0, 0, 1, 1});
  CHECK(h5.numbers("/links/rx") == Values{0, 1, 0, 1, 0, 1, 0, 1});
}

TEST_CASE("links.csv quotes what RFC 4180 wants quoted, and changes no name") {
  SampleRun sample;
  const std::vector<std::pair<std::string, std::string>> names = {
      {"=1+1", "=1+1"}, {"@a", "@a"}, {"-a", "-a"}, {"a\"b", "\"a\"\"b\""}, {"a,b", "\"a,b\""}, {"a b", "a b"}};
  for (const auto& [name, cell] : names) {
    CAPTURE(name);
    sample.config.receivers[0].name = name;
    const std::string csv = slurp(write_outputs(folder, sample.run(), sample.frames())[1]);
    CHECK(csv.find("\n0,\"rsu, north\"," + cell + ",1,") != std::string::npos);
  }
}

TEST_CASE("links.csv has a row per link, quoted names, and -inf where no path is") {
  const SampleRun sample;
  std::istringstream csv(slurp(write_outputs(folder, sample.run(), sample.frames())[1]));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  REQUIRE(lines.size() == 1 + 2 * 4);
  CHECK(lines[0] ==
        "time_s,tx,rx,paths,path_gain_db,sum_of_powers_db,narrowband_gain_db,mean_delay_s,rms_delay_spread_s,"
        "doppler_spread_hz,los,missed_power_share,received_dbm,snr_db,paths_left_out,left_out_power_share,"
        "tx_beam,rx_beam,beam_gain_db,k_factor_db");
  CHECK(lines[1].starts_with("0,\"rsu, north\",car,1,"));
  CHECK(lines[1].ends_with(",1,nan,nan,nan,0,0,nan,nan,nan,inf"));
  CHECK(lines[2].starts_with("0,\"rsu, north\",1,1,"));
  CHECK(lines[2].ends_with(",0,nan,nan,nan,0,0,nan,nan,nan,nan"));
  CHECK(lines[4].starts_with("0,rsu,1,0,-inf,-inf,"));
  CHECK(lines[5].starts_with("0.1,\"rsu, north\",car,1,"));
}

TEST_CASE("summary.json sums counts, takes medians of seconds and lists each warning once") {
  const SampleRun sample;
  const auto json = nlohmann::json::parse(slurp(write_outputs(folder, sample.run(), sample.frames())[2]));
  CHECK(json["version"] == WAVETRACER_VERSION);
  CHECK(json["device"] == "a processor");
  CHECK(json["driver"] == "3.1");
  CHECK(json["config_file"] == "/configs/sample.toml");
  CHECK(json["repeat_count"] == 3);
  CHECK(json["counts"] == nlohmann::json{{"rays", 2000},
                                         {"segments", 5000},
                                         {"hits", 3000},
                                         {"sequences", 80},
                                         {"candidates", 24},
                                         {"solved", 16},
                                         {"paths", 5},
                                         {"receptions", 6}});
  // Five paths have depths 0 to 4; every second vertex is a transmission.
  nlohmann::json kinds;
  for (const PathKind& kind : path_kinds) kinds[std::string(kind.word)] = 0;
  kinds.update({{"line_of_sight", 1}, {"reflected", 1}, {"transmitted", 3}});
  CHECK(json["paths_by_kind"] == kinds);
  CHECK(json["features"] ==
        nlohmann::json{{"reflection", {{"on", true}}},
                       {"diffraction", {{"on", false}, {"reason", "no edge of the scene diffracts"}}}});
  CHECK(json["segments_per_depth"] == std::vector<int>{2000, 1800, 1200});
  CHECK(json["seconds"]["frame"] == 1.0);
  CHECK(json["seconds"]["solve"] == 0.25);
  CHECK(json["seconds"]["load"] == 0.5);
  CHECK(json["seconds"]["trace"] == 0.5);
  CHECK(json["seconds"]["setup_trace"] == 9.0);
  CHECK(json["seconds"]["write"].get<double>() > 0);
  CHECK(json["rays_per_second"] == 5000.0);
  CHECK(json["frames_per_second"] == 1.0);
  CHECK(json["frames"] == 2);
  CHECK(json["first_frame"] == 7);
  CHECK(json["last_frame"] == 8);
  CHECK(json["end_s"] == 0.1);
  CHECK(json["links"] == 8);
  CHECK(json["vehicles"] == 2);
  CHECK(json["peak_memory_bytes"].get<uint64_t>() > 1000000);
  CHECK(json["order"]["method"] == "none");
  CHECK(json["cache"]["kind"] == "none");
  CHECK(json["warnings"] == std::vector<std::string>{"a run warning", "a warning", "a scene warning"});
}

TEST_CASE("a run without paths writes zero-length datasets") {
  const fs::path empty_folder = folder.parent_path() / "empty";
  const SampleRun sample;
  const auto written = write_outputs(empty_folder, sample.run(), sample.empty());
  const Reader h5(written[0]);
  CHECK(h5.shape("/paths/delay_s") == Shape{0});
  CHECK(h5.shape("/paths/a_re") == Shape{0, 1, 1});
  CHECK(h5.shape("/vertices/position_m") == Shape{0, 3});
  CHECK(h5.numbers("/paths/vertex_offset") == Values{0});
  CHECK(h5.numbers("/frames/path_offset") == Values{0, 0});
  CHECK(h5.numbers("/frames/time_s") == Values{0});
  const auto json = nlohmann::json::parse(slurp(written[2]));
  CHECK(json["counts"]["paths"] == 0);
  CHECK(json["rays_per_second"].is_null());
  CHECK(json["seconds"]["frame"] == 0.0);
  CHECK(slurp(written[1]).find("0,rsu,car,0,-inf,") != std::string::npos);
}

TEST_CASE("a config text beyond 64 KiB, an attribute's usual limit, arrives whole") {
  SampleRun sample;
  sample.config.text = std::string(200000, '#');
  const Reader h5(write_outputs(folder.parent_path() / "long", sample.run(), sample.frames())[0]);
  CHECK(h5.attribute("/", "config") == sample.config.text);
}

TEST_CASE("a name that is not UTF-8 does not keep summary.json from being valid JSON") {
  SampleRun sample;
  sample.config.file = "bad\xFFname.toml";
  const auto written = write_outputs(folder.parent_path() / "latin", sample.run(), sample.frames());
  CHECK(nlohmann::json::parse(slurp(written[2]))["config_file"] == "bad\xEF\xBF\xBDname.toml");
}
