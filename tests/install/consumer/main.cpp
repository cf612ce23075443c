// The library from outside: a city, two antennas, one frame.
// Fails unless there is a line of sight and at least one reflection.
#include <cstdio>

#include "wavetracer/simulation.hpp"

int main() {
  wavetracer::Config config;
  config.scene.generate = "--seed 1";
  config.transmitters = {{.name = "rsu", .position_m = {8, 8, 6}}};
  config.receivers = {{.name = "car", .position_m = {60, -3, 1.5}}};
  config.trace.rays = 100000;
  wavetracer::Simulation simulation(config);
  const wavetracer::FrameResult frame = simulation.run_frame(0);
  std::printf("%zu paths\n", frame.paths.size());
  return frame.paths.size() > 1 && frame.paths.depth.front() == 0 ? 0 : 1;
}
