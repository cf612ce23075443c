// SPDX-License-Identifier: Apache-2.0
// Builds summary.json; keys keep this order, so that two summaries compare line by line.
// Undefined numbers (a rate without a time) are null.
#include "output/summary_json.hpp"
#include <fmt/format.h>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "output/cache_json.hpp"
#include "output/median.hpp"
#include "output/run_advice.hpp"
#include "radio/missed_unknown.hpp"

namespace wavetracer {
namespace {

using Json = nlohmann::ordered_json;

// Writes setup stages, then those of a frame; "frame" comes last because it contains the ones before it.
// A setup stage with the name of a frame's stage is written as "setup_NAME".
Json stage_seconds(const Run& run, const Totals& totals, double write_seconds) {
  Json result = Json::object();
  for (const auto& [stage, seconds] : run.summary.setup_seconds)
    result[totals.seconds.contains(stage) ? "setup_" + stage : stage] = seconds;
  result["write"] = write_seconds;
  double sum = 0;
  for (const auto& [stage, values] : totals.seconds) {
    if (stage == "frame") continue;
    result[stage] = median(values);
    sum += median(values);
  }
  result["frame"] = totals.seconds.contains("frame") ? median_seconds(totals, "frame") : sum;
  return result;
}

// Returns a rate, such as things per second; null if `whole` is not positive.
Json rate(uint64_t count, double whole) { return whole > 0 ? Json(static_cast<double>(count) / whole) : Json(nullptr); }

Json counts(const Totals& totals, const TraceConfig& trace) {
  const bool leaves_out =
      (trace.reflects_scattered() && trace.scattering_floor_db) || (trace.target && trace.target_floor_db);
  Json json;
  for (const auto& [name, count, optional] : frame_count_names)
    if (!optional || leaves_out) json[name] = totals.counts.*count;
  return json;
}

Json path_counts(const PathKindCounts& kinds) {
  Json json;
  for (size_t i = 0; i < kinds.size(); ++i) json[std::string(path_kinds[i].word)] = kinds[i];
  return json;
}

// Rounds to three digits: more would be noise, and would depend on how frames were divided into shards.
double three_digits(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

Json range(const MissedRange& of) {
  return {{"estimate", three_digits(of.estimate)}, {"low", three_digits(of.low)}, {"high", three_digits(of.high)}};
}

Json certificate(const Certificate& of) {
  Json json = {{"depth", of.depth},
               {"any_depth", of.any_depth},
               {"edges", of.edges},
               {"left_out_sr", of.left_out_sr},
               {"left_out_share", of.left_out_share()},
               {"left_out_power", of.left_out_power}};
  if (!of.floor_db) return json;
  json["floor_db"] = *of.floor_db;
  json["weak_share"] = of.weak_share();
  return json;
}

// Writes what rays may have missed, where it is not known, and to which depth beams have found all paths.
void put_missed(const Run& run, const Totals& totals, Json& json) {
  if (totals.missed.frames > 0) {
    const Missed missed = estimate_missed(totals.missed);
    json["missed"] = {{"paths", range(missed.paths)}, {"power_share", range(missed.power_share)}};
  }
  if (totals.missed.unknown > 0)
    json["missed_unknown"] = {{"frames", totals.missed.unknown}, {"reason", missed_unknown_reason(run.config)}};
  if (totals.certificate.frames > 0) json["certificate"] = certificate(totals.certificate);
}

// Returns nothing if the text is not in the form of range().
std::optional<MissedRange> read_range(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  if (found == json.end() || !found->is_object()) return {};
  MissedRange out;
  for (const auto& [key, value] : {std::pair{"estimate", &out.estimate}, {"low", &out.low}, {"high", &out.high}}) {
    const auto number = found->find(key);
    if (number == found->end() || !number->is_number()) return {};
    *value = number->get<double>();
  }
  return out;
}

// Returns nothing if a number is missing or cannot be one of a certificate.
std::optional<CertificateFacts> read_certificate(const Json& json) {
  const auto found = json.find("certificate");
  if (found == json.end() || !found->is_object()) return {};
  CertificateFacts out;
  const auto depth = found->find("depth"), any = found->find("any_depth"), floor = found->find("floor_db");
  if (depth == found->end() || !depth->is_number_unsigned() || *depth > std::numeric_limits<uint32_t>::max()) return {};
  out.depth = *depth;
  if (any != found->end() && any->is_boolean()) out.any_depth = *any;
  if (const auto edges = found->find("edges"); edges != found->end() && edges->is_number_unsigned())
    out.edges = static_cast<uint32_t>(std::min<uint64_t>(edges->get<uint64_t>(), out.depth));
  // Takes a number that is not negative.
  const auto take = [&found](const char* name, double& value) {
    const auto number = found->find(name);
    if (number == found->end() || !number->is_number() || !(number->get<double>() >= 0)) return false;
    value = *number;
    return true;
  };
  if (!take("left_out_sr", out.left_out_sr) || !take("left_out_share", out.left_out_share)) return {};
  take("left_out_power", out.left_out_power);
  if (floor == found->end() || !floor->is_number()) return out;
  out.floor_db = *floor;
  if (!take("weak_share", out.weak_share)) return {};
  return out;
}

// Writes for each feature whether it was on, and if not, why.
Json features(const Features& all) {
  Json json = Json::object();
  for (const auto& [name, feature] : all) {
    json[name] = {{"on", feature.on}};
    if (!feature.on) json[name]["reason"] = feature.reason;
  }
  return json;
}

// hit_rate: the share of the look-ups that were answered.
Json cache(const CacheConfig& asked, const CacheSummary& done) {
  Json json = {{"kind", asked.kind.word()}};
  if (!done.on) return json;
  json["key"] = asked.key.word();
  json["hit_rate"] = rate(done.hits, static_cast<double>(done.lookups));
  json.update(encode_cache(done));
  return json;
}

// Writes the run's own warnings and those of the frames, each text once, in order of first appearance; then advice.
Json warnings(const Run& run, const Totals& totals) {
  std::vector<std::string> result;
  add_warnings(result, run.summary.warnings);
  add_warnings(result, run.scene.report.warnings);
  add_warnings(result, totals.warnings);
  add_warnings(result, missing_words(totals));
  add_warnings(result, advice(run, totals));
  return result;
}

// Returns the largest resident set of this process so far, as Linux reports it.
Json peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoull(line.substr(6));
  return nullptr;
}

}  // namespace

std::string encode_summary_json(const Run& run, const Totals& totals, double write_seconds, size_t shards) {
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
  json["flattened"] = {{"vertices", run.scene.report.flattened_vertices},
                       {"by_m", run.scene.report.flattened_by_m},
                       {"left_triangles", run.scene.report.bent_triangles},
                       {"tolerance_m", run.scene.report.plane_tolerance_m}};
  json["command_line"] = summary.command_line;
  json["vehicles"] = run.instances.size();
  json["frames"] = totals.frames;
  json["frames_asked"] = summary.frames_asked;
  json["first_frame"] = totals.first;
  json["last_frame"] = totals.last;
  json["start_s"] = totals.start_s;
  json["end_s"] = totals.end_s;
  json["shards"] = shards;
  json["repeat_count"] = summary.repeat_count;
  json["features"] = features(summary.features);
  if (summary.edge_rays > 0) json["edge_rays"] = summary.edge_rays;
  json["counts"] = counts(totals, run.config.trace);
  json["paths_by_kind"] = path_counts(totals.kinds);
  put_missed(run, totals, json);
  if (totals.late.discoveries > 0)
    json["late"] = {{"discoveries", totals.late.discoveries},
                    {"paths", totals.late.paths},
                    {"power_share", three_digits(totals.late.power_share())},
                    {"largest_power_share", three_digits(totals.late.largest_share)}};
  if (totals.left_out_at_edges > 0)
    json["left_out_at_edges"] = {{"range_db", summary.diffraction_range_db},
                                 {"largest_power_share", three_digits(totals.left_out_at_edges)}};
  if (totals.left_out.all > 0)
    json["left_out"] = {{"paths", totals.left_out.paths},
                        {"power_share", totals.left_out.all > 0 ? totals.left_out.power / totals.left_out.all : 0.0}};
  json["links"] = totals.links;
  json["segments_per_depth"] = totals.segments_per_depth;
  json["seconds"] = stage_seconds(run, totals, write_seconds);
  json["rays_per_second"] = rate(totals.timed_segments, sum_seconds(totals, "trace"));
  json["frames_per_second"] = rate(totals.frames, sum_seconds(totals, "frame"));
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["order"] = {{"asked", run.config.order.method.word()},
                   {"method", summary.order.method},
                   {"each_depth", summary.order.each_depth},
                   {"launch_shape", summary.order.launch_shape},
                   {"local_size", summary.order.local_size.value_or(0)},
                   {"reason", summary.order.reason}};
  json["cache"] = cache(run.config.cache, totals.cache);
  json["warnings"] = warnings(run, totals);
  // Names of files and devices may not be UTF-8; invalid bytes are replaced and not refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

SummaryFacts read_summary_json(const std::filesystem::path& file) {
  SummaryFacts out;
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return out;
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object()) return out;
  if (const auto device = json.find("device"); device != json.end() && device->is_string()) out.device = *device;
  if (const auto missed = json.find("missed"); missed != json.end()) {
    const auto paths = read_range(*missed, "paths"), power_share = read_range(*missed, "power_share");
    if (paths && power_share) out.missed = Missed{*paths, *power_share};
  }
  if (const auto unknown = json.find("missed_unknown"); unknown != json.end() && unknown->is_object())
    if (const auto reason = unknown->find("reason"); reason != unknown->end() && reason->is_string())
      out.missed_unknown = *reason;
  out.certificate = read_certificate(json);
  return out;
}

}  // namespace wavetracer
