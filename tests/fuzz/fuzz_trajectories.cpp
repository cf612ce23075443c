// SPDX-License-Identifier: Apache-2.0
// Fuzz target: trajectories, SUMO FCD, GPX and CSV, plain or gzip; the content decides.
#include "fuzz/fuzz.hpp"
#include "motion/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  TrajectoryOptions options;
  options.from_degrees = [](const glm::dvec2& degrees) { return 1e5 * degrees; };
  options.ground = [](const glm::dvec2& place_m) {
    return place_m.x < 0 ? std::optional<double>() : std::optional(place_m.y);
  };
  return fuzz::accept_or_refuse([&] { read_trajectories(file.write(data, size), options); });
}
