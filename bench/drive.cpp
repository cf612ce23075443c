// SPDX-License-Identifier: Apache-2.0
// Stages of the device come from its events; the rest of a frame is the host, transfers and waiting. The 95th
// percentile is the smallest value that at most 5 % of the frames exceed.
#include "drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "json_line.hpp"
#include "path_recall.hpp"
#include "timing.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

Simulation make_simulation(const Drive& drive, const Setting& setting, const std::string& device) {
  Config config = drive.config;
  config.trace.reuse = setting.reuse;
  config.trace.rays = setting.rays;
  config.trace.refresh_rays = setting.refresh_rays;
  Simulation simulation(config, device);
  simulation.profile_every(3);
  return simulation;
}

double percentile_95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto last = std::ceil(0.95 * static_cast<double>(values.size()));
  return values[static_cast<size_t>(last) - 1];
}

std::string name_of(const Setting& s) {
  std::string name = s.reuse ? "reuse, " : "cold, ";
  name += s.rays ? fmt::format("{:.0e} rays", static_cast<double>(*s.rays)) : "auto rays";
  if (s.reuse && s.refresh_rays) name += fmt::format(", {:.0e} anew", static_cast<double>(*s.refresh_rays));
  return name;
}

size_t transmitters_of(const std::vector<Link>& links) {  // links are sorted
  size_t count = 0;
  for (size_t i = 0; i < links.size(); i++) count += i == 0 || links[i].tx != links[i - 1].tx;
  return count;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Times of warm frames, and the stages of those that were profiled.
class FrameTimes {
 public:
  void add(const FrameResult& result) {
    frame_.push_back(result.seconds.at("frame"));
    if (result.kernels.empty()) return;
    double accounted = 0;
    for (const auto& [stage, seconds] : result.seconds) {
      if (stage == "frame") continue;
      seconds_[stage].push_back(seconds);
      accounted += seconds;
    }
    seconds_["other"].push_back(std::max(frame_.back() - accounted, 0.0));
    profiled_++;
  }
  const std::vector<double>& frame() const { return frame_; }

  // Returns medians, the longest first. A stage that was missing from a profiled frame counts as 0 there.
  std::vector<std::pair<std::string, double>> stages() const {
    std::vector<std::pair<std::string, double>> medians;
    for (auto [stage, seconds] : seconds_) {
      seconds.resize(profiled_, 0);
      medians.emplace_back(stage, median(seconds));
    }
    std::sort(medians.begin(), medians.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    return medians;
  }

 private:
  std::vector<double> frame_;
  std::map<std::string, std::vector<double>> seconds_;
  size_t profiled_ = 0;
};

}  // namespace

std::vector<uint32_t> compared_frames(uint32_t frames) {
  std::vector<uint32_t> compared;
  for (const uint32_t frame : {5u, 10u, 20u})
    if (frame + 1 < frames) compared.push_back(frame);
  compared.push_back(frames - 1);
  return compared;
}

References solve_references(const Drive& drive, uint64_t rays, const std::string& device) {
  References references;
  if (rays == 0) return references;
  Simulation simulation = make_simulation(drive, {.reuse = false, .rays = rays}, device);
  for (const uint32_t frame : compared_frames(drive.frames)) {
    FrameResult result = simulation.run_frame(frame);
    fmt::print(stderr, "{}: frame {} with {:.0e} rays per transmitter: {:.2f} s, {} paths\n", drive.name, frame,
               static_cast<double>(rays), result.seconds.at("frame"), result.paths.size());
    references[frame] = std::move(result.paths);
  }
  return references;
}

double measure(const Drive& drive, const Setting& setting, const References& references, const std::string& device,
               const std::string& command) {
  Simulation simulation = make_simulation(drive, setting, device);
  const std::vector<uint32_t> compared = compared_frames(drive.frames);
  std::vector<uint32_t> frames = compared;
  if (setting.reuse) {
    frames.clear();
    for (uint32_t frame = 1; frame < drive.frames; frame++) frames.push_back(frame);
  }

  FrameResult result = simulation.run_frame(0);  // allocates buffers, lets drivers finish compiling
  simulation.forget();
  result = simulation.run_frame(0);
  const double cold_s = result.seconds.at("frame");
  const uint64_t cold_rays = result.counts.rays / std::max<size_t>(transmitters_of(result.world.links), 1);
  FrameTimes times;
  std::vector<double> path_recalls, power_recalls;
  PathRecall last;
  for (const uint32_t frame : frames) {
    result = simulation.run_frame(frame);
    times.add(result);
    if (const auto reference = references.find(frame); reference != references.end()) {
      last = path_recall(reference->second, result.paths);
      path_recalls.push_back(last.paths);
      power_recalls.push_back(last.power);
    }
  }

  const double median_s = median(times.frame()), p95_s = percentile_95(times.frame());
  const uint64_t rays = result.counts.rays / std::max<size_t>(transmitters_of(result.world.links), 1);
  std::string stages;
  nlohmann::ordered_json stage_medians;
  for (const auto& [stage, seconds] : times.stages()) {
    stage_medians[stage] = seconds;
    if (seconds >= 0.01 * median_s) stages += fmt::format("{}{} {:.4g}", stages.empty() ? "" : ", ", stage, seconds);
  }
  Result line;
  line.bench = "drive";
  line.name = fmt::format("{}: {}", drive.name, name_of(setting));
  line.device = simulation.device().name;
  line.value = median_s;
  line.unit = "s per frame";
  line.better = Better::lower;
  line.baseline = setting.baseline;
  line.baseline_value = setting.baseline_s;
  line.extra = {{"frames", frames.size()},
                {"frames_s", 1 / median_s},
                {"p95_s", p95_s},
                {"cold_frame_s", cold_s},
                {"cold_rays", cold_rays},
                {"rays", rays},
                {"links", result.world.links.size()},
                {"paths", result.counts.paths},
                {"sequences", result.counts.sequences},
                {"candidates", result.counts.candidates},
                {"stages_s", stage_medians}};
  std::string recall = "recall not measured";
  if (!power_recalls.empty()) {
    line.error = 1 - power_recalls.back();
    line.extra.update({{"power_recall", power_recalls.back()},
                       {"path_recall", path_recalls.back()},
                       {"mean_power_recall", mean(power_recalls)},
                       {"mean_path_recall", mean(path_recalls)},
                       {"reference_paths", last.reference},
                       {"extra_paths", last.extra()}});
    recall = fmt::format("{:.4f} of {} paths and {} more, on average {:.4f} and {:.6f} of the power",
                         path_recalls.back(), last.reference, last.extra(), mean(path_recalls), mean(power_recalls));
  }
  line.detail = fmt::format(
      "{:.3g} frames/s, p95 {:.4g} s, cold frame {:.4g} s; {} links, {} paths, {} rays a transmitter; {}; {}",
      1 / median_s, p95_s, cold_s, result.world.links.size(), result.counts.paths, rays, recall, stages);
  for (const std::string& warning : result.warnings) fmt::print(stderr, "{}: {}\n", line.name, warning);
  print(line, command);
  return median_s;
}

}  // namespace wavetracer::bench
