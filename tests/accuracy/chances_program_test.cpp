// SPDX-License-Identifier: Apache-2.0
// Maps of samples of a drive in free space, and the program that writes them. Cases that need a device are skipped with
// a message if there is none.
#include <nlohmann/json.hpp>

#include "accuracy/chances.hpp"
#include "accuracy/free_space.hpp"
#include "accuracy/latin_hypercube.hpp"
#include "app/program.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string drive_file(const Folder& folder, const SceneFile& scene) {
  return folder.file(
      "drive.toml",
      head(scene, "max_depth = 0\nrays = 10\n") + grid("g", 0, 10, 2) +
          "[[track]]\nid = \"car\"\nwaypoints = [[0, 2, 6, 0], [1, 7, 6, 0], [2, 12, 6, 0], [3, 17, 6, 0], [4, 22, 6, 0]]\n[[mount]]\nname = \"roof\"\n"
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

TEST_CASE("chances: the antenna of a vehicle errs with it, by the same samples in all frames") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  constexpr uint32_t samples = 20;
  const accuracy::ChanceStudy study = studied(drive_file(folder, scene), {"received_dbm=-45"}, samples, {5, 0.5, 0, 3});
  CHECK(study.drive);
  CHECK(study.varied == std::array<bool, 4>{false, true, false, true});  // no antenna stands still but those of cells
  REQUIRE(study.maps.size() == 5);
  const auto rows = accuracy::normal_hypercube(samples, 3 + 2 + 1, 7);  // an antenna, a vehicle, and one material
  for (const coverage::Map& map : study.maps) {
    CAPTURE(map.frame);
    REQUIRE(map.columns == 5);
    for (size_t k = 0; k < map.columns; ++k) {
      const glm::dvec3 cell{1 + 2.0 * static_cast<double>(k), 0, cell_height_m};
      std::vector<double> gains, received;
      for (const std::vector<double>& row : rows) {
        const glm::dvec3 at{2 + 5 * map.time_s + 3 * row[3], 6 + 3 * row[4], 1.6 + 0.5 * row[2]};
        gains.push_back(gain_db(glm::distance(at, cell)));
        received.push_back(20 + gains.back());
      }
      CHECK(map.chances[k].path_gain_mean_db == doctest::Approx(mean_of(gains)).epsilon(1e-9));
      CHECK(map.chances[k].path_gain_deviation_db == doctest::Approx(deviation_of(gains)).epsilon(1e-6));
      CHECK(map.chances[k].received == share_from(received, -45));
    }
  }
}

TEST_CASE("chances: an interrupted study has the maps of the frames that are complete") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile scene = free_space();
  const accuracy::ChanceRequest request{
      .inputs = {.file = drive_file(folder, scene), .sets = {}, .device = "", .frames = 3, .samples = 4, .errors = {}},
      .thresholds = {"path_gain_db=-60"},
      .grid = "",
      .tx = ""};
  size_t asked = 0;
  const accuracy::ChanceStudy cut =
      accuracy::study_chances(request, {[](const std::string&) {}, [&] { return ++asked == 7; }});
  CHECK(cut.stopped);
  REQUIRE(cut.maps.size() == 1);
  CHECK(cut.maps[0].samples == 4);
  CHECK(accuracy::chances_text(cut).find("frame 0: 5 x 1 cells of g, 4 samples\n") != std::string::npos);
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
