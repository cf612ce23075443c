// SPDX-License-Identifier: Apache-2.0
// Profiles of delays tell a material where levels tell nothing. The cases need a device, and are skipped with a message
// if there is none.
#include <cmath>
#include <random>
#include <string>

#include "calibration/calibration.hpp"
#include "calibration/recovery.hpp"
#include "calibration/report.hpp"
#include "check_contains.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string profile_text(const SceneFile& scene, const std::string& more) {
  return fmt::format("scene.file = \"{}\"\n[radio]\nfrequency_hz = 5.9e9\n[trace]\nrays = 50000\nmax_depth = 2\n{}",
                     scene.path().string(), more) +
         "[[transmitter]]\nname = \"a\"\nposition_m = [-20, 3, 6]\n";
}

// The paths of a link are its components. Each link is stronger or weaker than it is by a number of its own.
std::string components_of(const Config& config) {
  Simulation simulation(config);
  const FrameResult frame = simulation.run_frame(0);
  std::mt19937_64 random(3);
  std::normal_distribution<double> error_db(0, 10);
  std::vector<double> errors;
  for (size_t i = 0; i < config.receivers.size(); ++i) errors.push_back(error_db(random));
  std::string out = "x,y,z,power_db,delay_ns\n";
  for (size_t row = 0; row < frame.paths.size(); ++row) {
    const auto& place = config.receivers[frame.paths.rx[row]].position_m;
    out += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", place[0], place[1], place[2],
                       frame.paths.gain_db[row] + errors[frame.paths.rx[row]], 1e9 * frame.paths.delay_s[row]);
  }
  return out;
}

}  // namespace

TEST_CASE("profiles of delays tell a permittivity where levels are wrong by 10 dB") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile street(
      {Part{{Quad{{-50, -10, 0}, {100, 0, 0}, {0, 20, 0}}}, "concrete"},
       Part{{Quad{{-50, 10, 0}, {100, 0, 0}, {0, 0, 15}}, Quad{{50, -10, 0}, {-100, 0, 0}, {0, 0, 15}}}, "brick"}});
  std::string truth = profile_text(street, "[[material]]\nname = \"material-1\"\npermittivity = 3.0\n");
  for (int i = 0; i < 25; ++i)
    truth += fmt::format("[[receiver]]\nname = \"r{:02}\"\nposition_m = [{}, {}, 1.5]\n", i, -10 + 2.1 * i, i % 7 - 3);
  calibration::Request request{
      .config =
          folder.file("start.toml", profile_text(street, "[[material]]\nname = \"material-1\"\npermittivity = 3.25\n")),
      .sets = {},
      .measured = {folder.file("m.csv", components_of(load_config(folder.file("true.toml", truth))))},
      .level = "",
      .device = "",
      .patterns = {"material-1.permittivity"},
      .profile_bin_ns = 10,
      .folds = 2};
  const study::Host host{[](const std::string&) {}, [] { return false; }};
  const calibration::Calibration with = calibration::calibrate(request, host);
  CHECK(fitted(with, "material-1.permittivity") == doctest::Approx(3.0).epsilon(0.005));
  CHECK(with.fit.used > 60);
  const std::string text = calibration::calibration_text(with);
  check_contains(text, "bins  median, dB  rms, dB");
  CHECK(text.find("held out", text.find("bins  median")) != std::string::npos);
  request.profile_bin_ns = 0;
  const calibration::Calibration without = calibration::calibrate(request, host);
  CHECK(std::abs(fitted(without, "material-1.permittivity") - 3.0) > 0.03);
  CHECK(without.fit.used == 25);
}

TEST_CASE("profiles need delays") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile floor({Part{{Quad{{-50, -10, 0}, {100, 0, 0}, {0, 20, 0}}}, "concrete"}});
  const calibration::Request request{.config = folder.file("c.toml", profile_text(floor, "")),
                                     .sets = {},
                                     .measured = {folder.file("m.csv", "x,y,z,path_gain_db\n1,2,1.5,-70\n")},
                                     .level = "",
                                     .device = "",
                                     .profile_bin_ns = 10};
  try {
    calibration::calibrate(request, {[](const std::string&) {}, [] { return false; }});
    FAIL("it was taken");
  } catch (const InputError& error) {
    check_contains(error.what(), "delay_ns");
  }
}
