// The built-in city with traffic, in which studies of caches drive.
// Assumes a config of the built-in city: its traffic is generated with the city's own options.
#include <fmt/format.h>
#include <cmath>
#include "study/cache_study.hpp"

namespace wavetracer::study {
namespace {

constexpr double frame_step_s = 0.01;  // 100 frames a second
constexpr uint32_t vehicles = 20;

}  // namespace

Config with_traffic(const Config& city, const std::string& drive, uint64_t frames) {
  Config config = city;
  // The cold frame, and those that are counted.
  config.time = {.start_s = 0.0, .end_s = frame_step_s * static_cast<double>(frames), .step_s = frame_step_s};
  config.trajectories.generate = fmt::format("{} --vehicles {} --seconds {:g} --step 0.1", city.scene.generate,
                                             vehicles, std::ceil(*config.time.end_s) + 1);
  MountConfig roof;
  roof.name = "roof";
  roof.role = "receiver";
  roof.offset_m = {0, 0, 1.6};
  config.mounts.push_back(roof);
  if (drive == "spheres") config.trace.reception = "sphere";
  if (drive == "moving") {
    MountConfig sender = roof;
    sender.name = "sender";
    sender.on = "veh0";
    sender.role = "transmitter";
    config.mounts.push_back(sender);
    config.transmitters.clear();
  }
  return config;
}

}  // namespace wavetracer::study
