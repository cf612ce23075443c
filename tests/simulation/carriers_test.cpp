// SPDX-License-Identifier: Apache-2.0
// Tests that a run with several carriers equals a run for each carrier: geometry is computed once, and fields are the
// same.
#include "simulation/run.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("radio.frequencies_hz: fields at every carrier are those of a run of its own, bit by bit") {
  const SceneFile scene(std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"},
                                          {{{{-30, 8, 0}, {60, 0, 0}, {0, 0, 12}}}, "glass"},
                                          {{{{0, -3, 0}, {0, 6, 0}, {0, 0, 4}}}, "metal"}});
  Config config = config_of(scene.path(), {{-12, 1.3, 5}}, {{11, -2.1, 1.5}, {5, 6, 2}}, 100000, 3);
  config.trace.diffraction = true;
  config.receivers[0].velocity_m_s = {10, 0, 0};
  config.radio.frequency_hz = 3.5e9;
  config.radio.frequencies_hz = {3.5e9, 28e9, 60e9};
  const FrameResult together = run(config);
  CHECK(together.paths.size() > 5);
  REQUIRE(together.carriers.size() == 2);
  for (size_t i = 0; i < 3; ++i) {
    Config alone = config;
    alone.radio.frequency_hz = config.radio.frequencies_hz[i];
    alone.radio.frequencies_hz.clear();
    const FrameResult frame = run(alone);
    CAPTURE(i);
    CHECK(frame.carriers.empty());
    CHECK(frame.paths.delay_s == together.paths.delay_s);
    if (i == 0) {
      CHECK(identical(frame.paths, together.paths));
    } else {
      CHECK(together.carriers[i - 1].frequency_hz == config.radio.frequencies_hz[i]);
      CHECK(frame.paths.a == together.carriers[i - 1].a);
      CHECK(frame.paths.gain_db == together.carriers[i - 1].gain_db);
      CHECK(frame.paths.doppler_hz == together.carriers[i - 1].doppler_hz);
    }
  }
  config.radio.frequency_hz = 28e9;
  CHECK_THROWS_AS(Simulation{config}, ConfigError);
}
