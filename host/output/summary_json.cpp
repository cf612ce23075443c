// Builds summary.json; keys keep this order, so that two summaries compare line by line.
// Numbers that do not exist (a rate without a time) are null.
#include "output/summary_json.hpp"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>
#include "output/median.hpp"

namespace wavetracer {
namespace {

using Json = nlohmann::ordered_json;

StageSeconds frame_medians(const std::vector<FrameResult>& frames) {
  std::map<std::string, std::vector<double>> samples;
  for (const FrameResult& frame : frames)
    for (const auto& [stage, seconds] : frame.seconds) samples[stage].push_back(seconds);
  StageSeconds result;
  for (const auto& [stage, values] : samples) result[stage] = median(values);
  return result;
}

// Setup stages, then those of a frame; "frame" closes the list because it contains the ones before it.
// A setup stage that shares its name with one of a frame is written as "setup_NAME".
Json stage_seconds(const RunData& run, double write_seconds) {
  StageSeconds frame = frame_medians(run.frames);
  const auto whole = frame.extract("frame");
  Json result = Json::object();
  for (const auto& [stage, seconds] : run.summary.setup_seconds)
    result[frame.contains(stage) ? "setup_" + stage : stage] = seconds;
  result["write"] = write_seconds;
  double sum = 0;
  for (const auto& [stage, seconds] : frame) {
    result[stage] = seconds;
    sum += seconds;
  }
  result["frame"] = whole.empty() ? sum : whole.mapped();
  return result;
}

// Rays traced a second of the trace stage, all depths; a ray is one segment in flight.
Json rays_per_second(const std::vector<FrameResult>& frames) {
  uint64_t segments = 0;
  double seconds = 0;
  for (const FrameResult& frame : frames) {
    segments += frame.counts.segments;
    if (const auto trace = frame.seconds.find("trace"); trace != frame.seconds.end()) seconds += trace->second;
  }
  return seconds > 0 ? Json(static_cast<double>(segments) / seconds) : Json(nullptr);
}

Json counts(const std::vector<FrameResult>& frames) {
  FrameCounts sum;
  for (const FrameResult& frame : frames) {
    sum.rays += frame.counts.rays;
    sum.segments += frame.counts.segments;
    sum.hits += frame.counts.hits;
    sum.sequences += frame.counts.sequences;
    sum.candidates += frame.counts.candidates;
    sum.solved += frame.counts.solved;
    sum.paths += frame.counts.paths;
  }
  return {{"rays", sum.rays},           {"segments", sum.segments},     {"hits", sum.hits},
          {"sequences", sum.sequences}, {"candidates", sum.candidates}, {"solved", sum.solved},
          {"paths", sum.paths}};
}

Json segments_per_depth(const std::vector<FrameResult>& frames) {
  std::vector<uint64_t> sums;
  for (const FrameResult& frame : frames) {
    sums.resize(std::max(sums.size(), frame.segments_per_depth.size()), 0);
    for (size_t depth = 0; depth < frame.segments_per_depth.size(); ++depth)
      sums[depth] += frame.segments_per_depth[depth];
  }
  return sums;
}

// The run's own warnings and the frames', each text once, in order of first appearance.
Json warnings(const RunData& run) {
  std::vector<std::string> result;
  const auto add = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      if (std::find(result.begin(), result.end(), text) == result.end()) result.push_back(text);
  };
  add(run.summary.warnings);
  add(run.scene.report.warnings);
  for (const FrameResult& frame : run.frames) add(frame.warnings);
  return result;
}

}  // namespace

std::string encode_summary_json(const RunData& run, double write_seconds) {
  const RunSummary& summary = run.summary;
  Json json;
  json["version"] = summary.version;
  json["device"] = summary.device.name;
  json["platform"] = summary.device.platform;
  json["driver"] = summary.device.driver;
  json["opencl_c"] = summary.device.opencl_c;
  json["device_kind"] = summary.device.gpu ? "gpu" : "cpu";
  json["config_file"] = run.config.file;
  json["scene_file"] = run.scene.file;
  json["command_line"] = summary.command_line;
  json["frames"] = run.frames.size();
  json["repeat_count"] = summary.repeat_count;
  json["counts"] = counts(run.frames);
  json["segments_per_depth"] = segments_per_depth(run.frames);
  json["seconds"] = stage_seconds(run, write_seconds);
  json["rays_per_second"] = rays_per_second(run.frames);
  json["order"] = {{"asked", run.config.order.method},
                   {"method", summary.order.method},
                   {"each_depth", summary.order.each_depth},
                   {"launch_shape", summary.order.launch_shape},
                   {"local_size", summary.order.local_size},
                   {"reason", summary.order.reason}};
  json["cache"] = {{"kind", run.config.cache.kind}};
  json["warnings"] = warnings(run);
  // Names of files and devices need not be UTF-8; what is not is replaced rather than refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace wavetracer
