// SPDX-License-Identifier: Apache-2.0
// The C++ interface through the shared library: configurations, errors that are caught by their class, threads.
// Links nothing of wavetracer but libwavetracer.so.
#include <doctest/doctest.h>
#include <cmath>
#include <filesystem>
#include <thread>
#include "wavetracer/wavetracer.h"
#include "wavetracer/wavetracer.hpp"

namespace {

wavetracer::Config street(double distance_m) {
  wavetracer::Config config;
  config.scene.generate = "--blocks 2";
  config.transmitters = {{.name = "t", .position_m = {0, 0, 6}}};
  config.receivers = {{.name = "r", .position_m = {distance_m, 0, 6}}};
  config.trace.rays = 20000;
  config.trace.max_depth = 2;
  return config;
}

}  // namespace

TEST_CASE("configurations are read and written back through the library") {
  CHECK(wavetracer::parse_config(wavetracer::commented_config(), "init.toml").trace.rays == 200000);
  const wavetracer::Config config = wavetracer::parse_config(wavetracer::resolved_config(street(30)), "street.toml");
  CHECK(config.receivers.at(0).position_m[0] == 30);
  CHECK_THROWS_AS(wavetracer::load_config("/nowhere.toml"), wavetracer::Error);
}

TEST_CASE("exceptions keep their class and code across the library's boundary") {
  CHECK_THROWS_AS(wavetracer::parse_config("x = ", "bad.toml"), wavetracer::ConfigError);
  wavetracer::Config config = street(30);
  config.scene.generate.clear();
  config.scene.file = "/nowhere.xml";
  CHECK_THROWS_AS(wavetracer::Simulation{config}, wavetracer::InputError);
  try {
    wavetracer::Simulation simulation(street(30), "no such device");
    FAIL("a device that is not there");
  } catch (const wavetracer::Error& e) {
    CHECK(e.code() == wavetracer::ExitCode::device);
  }
}

TEST_CASE("simulations in threads of their own do not disturb each other") {
  std::vector<wavetracer::FrameResult> together(2);
  const double distance_m[] = {30, 40};
  {
    std::vector<std::jthread> threads;
    for (size_t i = 0; i < 2; ++i)
      threads.emplace_back([&, i] { together[i] = wavetracer::Simulation(street(distance_m[i])).run_frame(0); });
  }
  for (size_t i = 0; i < 2; ++i) {
    const wavetracer::FrameResult alone_i = wavetracer::Simulation(street(distance_m[i])).run_frame(0);
    CHECK(alone_i.paths.size() > 1);
    CHECK(alone_i.paths.delay_s == together[i].paths.delay_s);
    CHECK(alone_i.paths.a == together[i].paths.a);
    CHECK(together[i].paths.delay_s.at(0) == doctest::Approx(distance_m[i] / 299792458.0).epsilon(1e-12));
  }
}

TEST_CASE("outputs are written as the program writes them") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "wavetracer_library_test";
  wavetracer::Simulation simulation(street(30));
  const wavetracer::FrameResult frame = simulation.run_frame(0);
  const auto files = wavetracer::write_outputs(folder, wavetracer::make_run(simulation), {&frame, 1});
  REQUIRE(files.size() == 3);
  for (const auto& file : files) CHECK(std::filesystem::file_size(file) > 0);
  std::filesystem::remove_all(folder);
}

TEST_CASE("elements of arrays: positions, coefficients and responses are exported") {
  wavetracer::Config config = street(30);
  config.arrays.resize(1);
  config.arrays[0].name = "pair";
  config.arrays[0].columns = 2;
  config.transmitters[0].array = "pair";
  config.trace.max_depth = 0;
  config.response.bandwidth_hz = 1e6;
  config.response.subcarriers = 2;
  wavetracer::Simulation simulation(config);
  const wavetracer::FrameResult frame = simulation.run_frame(0);
  const wavetracer::ElementModel model(simulation);
  CHECK(wavetracer::element_positions_m(simulation.config(), simulation.config().transmitters[0]).size() == 2);
  CHECK(model.coefficients(frame, 0).size() == 2);
  CHECK(model.element_paths(frame, 0).delay_s.size() == 2);
  const auto h = model.response(frame, {0, 0}, wavetracer::response_frequencies_hz(simulation.config()),
                                wavetracer::response_times_s(simulation.config()));
  REQUIRE(h.size() == frame.responses.h.size());
  CHECK(std::abs(h[3] - std::complex<double>(frame.responses.h[3])) < 1e-6 * std::abs(h[3]));
}
