// SPDX-License-Identifier: Apache-2.0
// A fit uses those measured spreads that it is asked to use. The case needs a device, and is skipped with a message if
// there is none.
#include <utility>

#include "app/program.hpp"
#include "calibration/calibration.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using calibration::FittedSpreads;

TEST_CASE("a fit uses the levels, and the spreads that it is asked to use") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile corner({Part{{Quad{{-50, 10, -20}, {100, 0, 0}, {0, 0, 40}}}, "brick"},
                          Part{{Quad{{50, -10, -20}, {0, 20, 0}, {0, 0, 40}}}, "concrete"}});
  const std::string config = folder.file(
      "c.toml", fmt::format("scene.file = \"{}\"\n[radio]\nfrequency_hz = 5.9e9\n[trace]\nrays = 50000\nmax_depth = 1\n"
                            "[[transmitter]]\nname = \"a\"\nposition_m = [-20, 3, 6]\n",
                            corner.path().string()));
  std::string rows = "x,y,z,path_gain_db,delay_spread_ns,azimuth_spread_deg\n";
  for (int i = 0; i < 12; ++i) rows += fmt::format("{},-2,1.5,{},{},20\n", 3 * i, -80 - 0.3 * i, 12 + i % 3);
  const calibration::Request request{.config = config,
                                     .sets = {},
                                     .measured = {folder.file("m.csv", rows)},
                                     .level = "",
                                     .device = "",
                                     .patterns = {"*.permittivity"},
                                     .folds = 0};
  const std::pair<FittedSpreads, size_t> cases[] = {{FittedSpreads("none"), 12},
                                                    {FittedSpreads("delay"), 24},
                                                    {FittedSpreads("azimuth"), 24},
                                                    {FittedSpreads("all"), 36}};
  for (const auto& [spreads, used] : cases) {
    CAPTURE(spreads.word());
    calibration::Request asked = request;
    asked.spreads = spreads;
    const calibration::Calibration found =
        calibration::calibrate(asked, {[](const std::string&) {}, [] { return false; }});
    CHECK(found.fit.used == used);
    for (const calibration::FittedPoint& point : found.points) {
      CHECK(point.before.delay_spread_ns > 0);
      CHECK(point.before.azimuth_spread_deg > 0);
    }
  }
  CHECK(calibration::Request{}.spreads == FittedSpreads("none"));
}
