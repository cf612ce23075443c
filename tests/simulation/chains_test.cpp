// SPDX-License-Identifier: Apache-2.0
// Tests paths over three and more edges in whole frames: over screens and vehicles, in both directions, in blocks and
// in drives.
#include <cstdlib>

#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint8_t diffraction = 8;

// Screens 10 m apart, their tops on a parabola, and a ground: the string from end to end touches all.
std::vector<Quad> screens_in_a_row(uint32_t count) {
  std::vector<Quad> quads{{{-40, -60, 0}, {40 + 10.0 * count + 60, 0, 0}, {0, 120, 0}}};
  for (uint32_t i = 0; i < count; ++i) {
    const double x = 10.0 * (i + 1), from_middle = x - 5.0 * (count + 1);
    quads.push_back({{x, -50, 0}, {0, 100, 0}, {0, 0, 12 - 0.005 * from_middle * from_middle}});
  }
  return quads;
}

Config over_screens(const SceneFile& file, uint32_t edges) {
  Config config;
  config.scene.file = file.path().string();
  config.radio.frequency_hz = carrier_hz;
  config.transmitters = {{"tx", {-9.3, 0.7, 2.1}}};
  config.receivers = {{"rx", {69.1, -3.2, 1.7}}};
  config.trace = diffracting(50000, 2);
  config.trace.max_diffractions = edges;
  return config;
}

size_t deepest(const Paths& paths) {
  size_t most = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.depth[i] > 2) {
      ++most;
      for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
        CHECK(paths.vertex_interaction[k] == diffraction);
    }
  return most;
}

}  // namespace

TEST_CASE("six screens: a path over all of them where six edges are allowed, and none but the others where not") {
  const SceneFile file(screens_in_a_row(6));
  const Paths two = run(over_screens(file, 2)).paths, five = run(over_screens(file, 5)).paths;
  const Paths six = run(over_screens(file, 6)).paths, eight = run(over_screens(file, 8)).paths;
  CHECK(deepest(two) == 0);
  CHECK(identical(five, two));
  REQUIRE(deepest(six) == 1);
  CHECK(six.size() == two.size() + 1);
  CHECK(missing(two, six) == 0);
  CHECK(identical(eight, six));
  const size_t row = static_cast<size_t>(std::ranges::max_element(six.depth) - six.depth.begin());
  CHECK(six.depth[row] == 6);
  for (uint64_t k = 0; k < 6; ++k)
    CHECK(std::abs(six.vertex_position_m[six.vertex_offset[row] + k].x - 10.0 * static_cast<double>(k + 1)) < 1e-6);
  CHECK(std::isfinite(six.gain_db[row]));
}

TEST_CASE("a vehicle between screens is one of the edges, frame by frame") {
  std::vector<Quad> quads = screens_in_a_row(2);
  quads[1].v.z = 2.8;
  quads[2].v.z = 2.9;
  quads[2].corner.x = 40;
  const SceneFile file(quads);
  Config config = over_screens(file, 4);
  config.vehicle_types = vehicle_types();
  config.tracks = {{"truck", "truck", {{0, 24, -9, 0}, {1, 24.5, 9, 0}}}};
  config.time = {0, 1, 0.25};
  config.trace.reuse = true;
  Simulation drive(config);
  config.trace.reuse = false;
  Simulation cold(config);
  size_t over_truck = 0, without = 0;
  for (uint32_t frame = 0; frame < 4; ++frame) {
    const Paths paths = drive.run_frame(frame).paths;
    size_t chains = 0;
    for (size_t i = 0; i < paths.size(); ++i)
      if (paths.depth[i] > 2 && by_vehicle(paths, i)) ++chains;
    (chains > 0 ? over_truck : without) += 1;
    CHECK(missing(paths, cold.run_frame(frame).paths) == 0);
  }
  CHECK(over_truck >= 1);
  CHECK(without >= 1);  // it has not come yet, or has passed
}

TEST_CASE("frames in blocks of links, and links both ways, have the same chains") {
  const SceneFile file(screens_in_a_row(5));
  Config config = over_screens(file, 8);
  config.receivers.push_back({"rx2", {69.1, 9.2, 1.1}});
  config.receivers.push_back({"rx3", {57.1, -11.2, 4.7}});
  Simulation simulation(config);
  const FrameResult whole = simulation.run_frame(0);
  REQUIRE(deepest(whole.paths) >= 3);
  size_t rows = 0;
  for (const uint32_t first : {0u, 1u, 2u}) rows += deepest(simulation.run_block(0, {first, first + 1}).paths);
  CHECK(rows == deepest(whole.paths));

  Config back = over_screens(file, 8);
  std::swap(back.transmitters, back.receivers);
  const Paths there = run(over_screens(file, 8)).paths, again = run(back).paths;
  REQUIRE(deepest(there) == 1);
  const size_t i = static_cast<size_t>(std::ranges::max_element(there.depth) - there.depth.begin());
  const size_t j = static_cast<size_t>(std::ranges::max_element(again.depth) - again.depth.begin());
  REQUIRE(there.depth[i] == again.depth[j]);
  for (uint64_t k = 0; k < there.depth[i]; ++k)
    CHECK(there.vertex_position_m[there.vertex_offset[i] + k] ==
          again.vertex_position_m[again.vertex_offset[j + 1] - 1 - k]);
  CHECK(std::abs(there.gain_db[i] - again.gain_db[j]) < 1e-6);
}
