// SPDX-License-Identifier: Apache-2.0
// trace.edge_rays in config files: what it does not go with.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "config/edge_rays.hpp"
#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("rays from edges are refused with what they would lose") {
  const std::string on = "trace.edge_rays = 500\ntrace.diffraction = true\n";
  CHECK(error_of(scene + on + ends) == "no error");
  for (const std::string& line : std::vector<std::string>{"trace.max_diffractions = 2", "trace.transmission = true",
                                                          "trace.discovery = \"beams\"", "cache.kind = \"open\""}) {
    CAPTURE(line);
    check_contains(error_of(scene + on + line + "\n" + ends),
                   "trace.edge_rays = 500 does not go with " + line + ": give trace.edge_rays = 0");
    CHECK(error_of(scene + "trace.edge_rays = 500\n" + line + "\n" + ends).find("edge_rays") == std::string::npos);
  }
  // A receiver that launches no rays has no mirrors before its tiles.
  const std::string mirrors = "trace.scattering_reflections = 2\n";
  check_contains(error_of(scene + on + "trace.scattering = true\n" + mirrors + ends),
                 "trace.edge_rays = 500 does not go with trace.scattering_reflections = 2: give trace.edge_rays = 0");
  CHECK(error_of(scene + on + mirrors + ends).find("edge_rays") == std::string::npos);  // without scattering
  check_contains(error_of(scene + "trace.edge_rays = 65537\n" + ends), "out of range");
}

TEST_CASE("with \"auto\" rays start at edges where many receivers do not transmit, and nothing forbids them") {
  const auto rays = [](const std::string& lines, uint32_t receivers) {
    Config config = parse_config(scene + lines + ends, "a.toml", {});
    config.receivers.resize(receivers);
    for (uint32_t i = 0; i < receivers; ++i) config.receivers[i].name = "cell " + std::to_string(i);
    config.receivers[0].name = "t";  // the transmitter
    return config::edge_rays_of(config, config.trace);
  };
  const std::string on = "trace.diffraction = true\n";
  CHECK(rays(on, 1002) == config::automatic_edge_rays);
  CHECK(rays(on, 1001) == 0);
  CHECK(rays(on + "trace.edge_rays = \"auto\"\n", 1002) == config::automatic_edge_rays);
  CHECK(rays(on + "trace.edge_rays = 0\n", 1002) == 0);
  CHECK(rays(on + "trace.edge_rays = 20\n", 2) == 20);
  CHECK(rays("", 1002) == 0);
  for (const std::string& line : std::vector<std::string>{
           "trace.max_diffractions = 2", "trace.transmission = true", "trace.discovery = \"beams\"",
           "trace.diffraction_rays = 500", "trace.scattering = true\ntrace.scattering_reflections = 1"}) {
    CAPTURE(line);
    CHECK(rays(on + line + "\n", 1002) == 0);
  }
}
