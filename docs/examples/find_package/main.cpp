// SPDX-License-Identifier: Apache-2.0
// A street of a generated city, a road-side unit and a car: every path between them, printed and written to a folder.
// Usage: example [FOLDER]. Exits with the code that the program would exit with.
#include <cstdio>
#include <exception>
#include <string>
#include "wavetracer/wavetracer.hpp"

namespace {

std::string name_of(uint8_t interaction) {
  const wavetracer::InteractionKind* kind = wavetracer::find_interaction(interaction);
  return kind ? std::string(kind->word) : "unknown";
}

void print(const wavetracer::Paths& paths) {
  for (size_t i = 0; i < paths.size(); ++i) {
    std::printf("%9.2f ns %8.2f dB", paths.delay_s[i] * 1e9, paths.gain_db[i]);
    for (uint64_t v = paths.vertex_offset[i]; v < paths.vertex_offset[i + 1]; ++v) {
      const glm::dvec3& p = paths.vertex_position_m[v];
      std::printf("  %s (%.2f, %.2f, %.2f)", name_of(paths.vertex_interaction[v]).c_str(), p.x, p.y, p.z);
    }
    std::puts(paths.depth[i] == 0 ? "  line of sight" : "");
  }
}

int trace(const char* folder) {
  wavetracer::Config config;
  config.scene.generate = "--seed 1";
  config.transmitters = {{.name = "rsu", .position_m = {8, 8, 6}}};
  config.receivers = {{.name = "car", .position_m = {60, -3, 1.5}}};
  config.trace.rays = 100000;
  config.trace.max_depth = 2;
  config.text = wavetracer::resolved_config(config);  // outputs contain it as their origin

  wavetracer::Simulation simulation(config);
  const wavetracer::FrameResult frame = simulation.run_frame(0);
  std::printf("%zu paths on %s\n", frame.paths.size(), simulation.device().name.c_str());
  print(frame.paths);
  if (folder)
    for (const auto& file : wavetracer::write_outputs(folder, wavetracer::make_run(simulation), {&frame, 1}))
      std::printf("written %s\n", file.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return trace(argc > 1 ? argv[1] : nullptr);
  } catch (const wavetracer::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
