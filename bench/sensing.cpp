// SPDX-License-Identifier: Apache-2.0
// Frames reuse sequences; the first one warms up and is not counted.
#include "sensing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <map>
#include <optional>
#include <vector>

#include "json_line.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

struct Sensed {
  double median_s = 0, echo_power = 0;
  size_t paths = 0, echoes = 0;
  uint64_t weak = 0;
  std::map<std::string, double> stages;  // seconds of a frame
  std::string device;
};

Sensed sense(const Config& config, uint32_t frames, const std::string& device) {
  Simulation simulation(config, device);
  Sensed out;
  out.device = simulation.device().name;
  std::vector<double> seconds;
  const auto count = static_cast<uint32_t>(std::min<uint64_t>(simulation.frame_count(), frames));
  for (uint32_t frame = 0; frame < count; ++frame) {
    const FrameResult result = simulation.run_frame(frame);
    if (frame == 0) continue;
    seconds.push_back(result.seconds.at("frame"));
    for (const auto& [stage, value] : result.seconds)
      if (stage != "frame") out.stages[stage] += value / (count - 1);
    out.weak = result.counts.weak;
    out.paths = result.paths.size();
    if (frame + 1 < count) continue;
    for (size_t i = 0; i < result.paths.target.size(); ++i) {
      if (result.paths.target[i] == no_target) continue;
      ++out.echoes;
      out.echo_power += std::norm(result.paths.a[i][0]);
    }
  }
  std::nth_element(seconds.begin(), seconds.begin() + static_cast<ptrdiff_t>(seconds.size() / 2), seconds.end());
  out.median_s = seconds[seconds.size() / 2];
  return out;
}

std::string slowest(const std::map<std::string, double>& stages) {
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [stage, seconds] : stages) order.emplace_back(seconds, stage);
  std::ranges::sort(order, std::greater());
  std::string out;
  for (size_t i = 0; i < std::min<size_t>(order.size(), 4); ++i)
    out += fmt::format(", {} {:.2g} ms", order[i].second, 1e3 * order[i].first);
  return out;
}

// Prints the lines of one choice of antennas.
void measure(const std::string& name, const Config& config, uint32_t frames, const std::string& device,
             const std::string& command) {
  constexpr uint32_t reflections = 1;
  const Sensed plain = sense(config, frames, device);
  const auto show = [&](const std::string& what, const Sensed& sensed, double error) {
    Result line;
    line.bench = "drive";
    line.name = fmt::format("{}: {}", name, what);
    line.device = sensed.device;
    line.value = sensed.median_s;
    line.unit = "s per frame";
    line.better = Better::lower;
    if (&sensed != &plain) {
      line.baseline = "without targets";
      line.baseline_value = plain.median_s;
    }
    line.error = error;
    line.detail = fmt::format("{} paths, {} of them over targets, {} left out as weak{}", sensed.paths, sensed.echoes,
                              sensed.weak, slowest(sensed.stages));
    print(line, command);
  };
  show("without targets", plain, 0);
  Config sensing = config;
  TargetModelConfig car;
  car.name = "car";
  car.on = "*";
  car.kind = "vehicle-points";
  sensing.target_models = {car};
  sensing.trace.target_reflections = reflections;
  std::optional<double> power;
  for (const std::optional<double> floor_db : {std::optional<double>(), {-160}, {-140}}) {
    sensing.trace.target_floor_db = floor_db;
    const Sensed sensed = sense(sensing, frames, device);
    if (!power) power = sensed.echo_power;
    const std::string floor = floor_db ? fmt::format(", floor {:g} dB", *floor_db) : "";
    show(fmt::format("targets of five points, {} mirrors{}", reflections, floor), sensed,
         1 - sensed.echo_power / *power);
  }
}

}  // namespace

void print_sensing(const std::string& name, const Config& config, uint32_t frames, const std::string& device,
                   const std::string& command) {
  Config one = config;
  const std::string vehicle = one.tracks.front().id;
  one.mounts.clear();
  for (const char* role : {"transmitter", "receiver"})
    one.mounts.push_back({.name = role, .on = vehicle, .role = MountRole::named(role), .offset_m = {2.6, 0, 0.6}});
  one.links.same_vehicle = true;
  measure(name + ", a radar on one", one, frames, device, command);
  measure(name + ", antennas on all", config, frames, device, command);
}

}  // namespace wavetracer::bench
