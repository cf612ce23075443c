// SPDX-License-Identifier: Apache-2.0
// Tests the cases in which the theory of diffraction is not valid: edges within a wavelength of an antenna or of
// another edge, and edges shorter than that.
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns the number of paths outside the validity of the theory, from the frame's warnings; nothing if there is no
// such warning.
std::optional<int> near_edges(const FrameResult& frame, size_t* warnings = nullptr) {
  std::optional<int> out;
  for (const std::string& text : frame.warnings) {
    if (text.find("are diffracted less than a wavelength") == text.npos) continue;
    out = std::stoi(text);
    if (warnings) ++*warnings;
  }
  return out;
}

// A screen of 6 x 6 m, an antenna 3 m before it, another far behind it.
Config behind_a_screen(const MeshFile& scene, double frequency_hz) {
  Config config = config_of(scene.path(), {{0, 0, 3}}, {{0, 400, 3}}, 5000, 2);
  config.trace.diffraction = true;
  config.radio.frequency_hz = frequency_hz;
  config.scene.extrapolate_materials = true;
  return config;
}

MeshFile screen(const glm::dvec3& width, const glm::dvec3& height) {
  const Part part{{{-width / 2.0 - height / 2.0 + glm::dvec3(0, 3, 3), width, height}}};
  return MeshFile({mesh_of(part)});
}

}  // namespace

TEST_CASE("a screen near an antenna at 10 MHz is beyond the theory, at 1 GHz it is not") {
  const MeshFile scene = screen({6, 0, 0}, {0, 0, 6});
  const FrameResult low = run(behind_a_screen(scene, 1e7)), high = run(behind_a_screen(scene, 1e9));
  REQUIRE(low.paths.size() >= 4);
  CHECK(near_edges(low) == static_cast<int>(low.paths.size()));
  CHECK_FALSE(near_edges(high));
  // Just beyond: 4.24 m from the antenna to the edges, which are 6 m long.
  CHECK_FALSE(near_edges(run(behind_a_screen(scene, speed_of_light / 4.2))));
  CHECK(near_edges(run(behind_a_screen(scene, speed_of_light / 4.3))));
}

TEST_CASE("edges that are shorter than a wavelength, however far away") {
  const MeshFile scene = screen({0.5, 0, 0}, {0, 0, 8});
  Config config = behind_a_screen(scene, 3e8);
  config.transmitters[0].position_m = {0, -40, 3};
  const FrameResult frame = run(config);
  REQUIRE(near_edges(frame));
  CHECK(*near_edges(frame) < static_cast<int>(frame.paths.size()));  // the long ones are within it
  config.radio.frequency_hz = 3e9;
  CHECK_FALSE(near_edges(run(config)));
}

TEST_CASE("each carrier has a wavelength of its own") {
  const MeshFile scene = screen({6, 0, 0}, {0, 0, 6});
  Config config = behind_a_screen(scene, 1e9);
  config.materials = {
      {.name = "material-0", .permittivity = 1, .conductivity_s_m = 1e7}};  // of the part, at any carrier
  config.radio.frequencies_hz = {1e9, 2e9, 1e7, 5e6};
  size_t warnings = 0;
  CHECK(near_edges(run(config), &warnings));
  CHECK(warnings == 2);
}
