// SPDX-License-Identifier: Apache-2.0
// Converts to and from JSON.
// Only the number of vehicles is kept, since summary.json has nothing else of them.
#include "jobs/run_record.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include "base/file.hpp"
#include "base/json_whole.hpp"
#include "jobs/checked_text.hpp"
#include "radio/codebook.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint64_t most_vehicles = uint64_t{1} << 24, most_record_bytes = uint64_t{1} << 26;

}  // namespace

std::string encode_run_record(const Run& run) {
  const RunSummary& s = run.summary;
  Json json;
  json["version"] = s.version;
  json["device"] = {{"platform", s.device.platform},
                    {"name", s.device.name},
                    {"driver", s.device.driver},
                    {"opencl_c", s.device.opencl_c},
                    {"gpu", s.device.gpu}};
  json["order"] = {{"asked", run.config.order.method.word()},
                   {"method", s.order.method},
                   {"each_depth", s.order.each_depth},
                   {"launch_shape", s.order.launch_shape},
                   {"local_size", s.order.local_size.value_or(0)},
                   {"reason", s.order.reason}};
  json["edge_rays"] = s.edge_rays;
  json["diffraction_range_db"] = s.diffraction_range_db;
  json["features"] = Json::object();
  for (const auto& [name, feature] : s.features)
    json["features"][name] = {{"on", feature.on}, {"reason", feature.reason}};
  json["setup_seconds"] = s.setup_seconds;
  json["command_line"] = s.command_line;
  json["frames_asked"] = s.frames_asked;
  json["repeat_count"] = s.repeat_count;
  json["warnings"] = s.warnings;
  json["config_file"] = run.config.file;
  json["config"] = run.config.text;
  json["reuse"] = run.config.trace.reuse;
  json["waypoints"] = run.config.output.waypoints;
  json["cache_entries"] = run.config.output.cache_entries;
  json["responses"] = run.config.response.bandwidth_hz.has_value();
  json["beams"] = has_beams(run.config);
  json["radars"] = Json::array();
  for (const RadarConfig& radar : run.config.radars)
    json["radars"].push_back({{"name", radar.name}, {"cube", radar.cube}});
  json["carriers"] = run.config.radio.frequencies_hz.size();
  json["compression"] = run.config.output.compression;
  json["cache"] = {{"kind", run.config.cache.kind.word()}, {"key", run.config.cache.key.word()}};
  json["scene_file"] = run.scene.file;
  json["scene_warnings"] = run.scene.report.warnings;
  json["scene_flattened"] = {{"vertices", run.scene.report.flattened_vertices},
                             {"by_m", run.scene.report.flattened_by_m},
                             {"left_triangles", run.scene.report.bent_triangles},
                             {"tolerance_m", run.scene.report.plane_tolerance_m}};
  json["vehicles"] = run.instances.size();
  json["inputs"] = Json::array();
  for (const InputFile& input : s.inputs)
    json["inputs"].push_back(
        {{"name", input.name}, {"file", input.file}, {"bytes", input.bytes}, {"hash", input.hash}});
  return with_check(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

namespace {

// Restores the part of the configuration that says which files of elements the run writes; older versions write none.
void restore_element_outputs(const Json& json, Config& config) {
  if (json.value("responses", false)) config.response.bandwidth_hz = 1;
  if (json.value("beams", false)) config.arrays.emplace_back().codebook = "dft";
  if (json.contains("radars"))
    for (const Json& radar : json.at("radars")) {
      config.radars.emplace_back().name = radar.at("name").get<std::string>();
      config.radars.back().cube = radar.at("cube").get<bool>();
    }
  if (json.contains("carriers") && whole_at<uint64_t>(json, "carriers") > 1) config.radio.frequencies_hz = {1, 2};
}

}  // namespace

RunRecord decode_run_record(std::string_view text, const std::string& name) try {
  const Json json = Json::parse(text);
  RunRecord out;
  RunSummary& s = out.summary;
  s.version = json.at("version");
  const Json& device = json.at("device");
  s.device = {device.at("platform"), device.at("name"), device.at("driver"), device.at("opencl_c"), device.at("gpu")};
  const Json& order = json.at("order");
  out.config.order.method = OrderMethod::named(order.at("asked").get<std::string>());
  s.order = {order.at("method"), order.at("each_depth"), order.at("launch_shape"), {}, order.at("reason")};
  if (const auto local_size = whole_at<uint32_t>(order, "local_size"); local_size > 0) s.order.local_size = local_size;
  s.diffraction_range_db = json.value("diffraction_range_db", 0.0);
  if (json.contains("edge_rays")) s.edge_rays = whole_at<uint64_t>(json, "edge_rays");
  for (const auto& [feature, value] : json.at("features").items())
    s.features[feature] = {value.at("on"), value.at("reason")};
  s.setup_seconds = json.at("setup_seconds").get<StageSeconds>();
  s.command_line = json.at("command_line");
  s.frames_asked = whole_at<uint64_t>(json, "frames_asked");
  s.repeat_count = whole_at<uint32_t>(json, "repeat_count");
  s.warnings = json.at("warnings").get<std::vector<std::string>>();
  out.config.file = json.at("config_file");
  if (json.contains("config")) out.config.text = json.at("config");
  out.config.trace.reuse = json.at("reuse");
  out.config.output.waypoints = whole_at<uint64_t>(json, "waypoints");
  if (json.contains("cache_entries")) out.config.output.cache_entries = json.at("cache_entries").get<bool>();
  restore_element_outputs(json, out.config);
  if (json.contains("compression")) out.config.output.compression = whole_at<uint32_t>(json, "compression");
  if (out.config.output.compression > 9) throw RuntimeError(name + ": \"compression\" is no level from 0 to 9");
  out.config.cache.kind = CacheKind::named(json.at("cache").at("kind").get<std::string>());
  out.config.cache.key = CacheKey::named(json.at("cache").at("key").get<std::string>());
  out.scene.file = json.at("scene_file");
  out.scene.report.warnings = json.at("scene_warnings").get<std::vector<std::string>>();
  if (const auto flat = json.find("scene_flattened"); flat != json.end()) {  // older versions do not write it
    out.scene.report.flattened_vertices = whole_at<uint64_t>(*flat, "vertices");
    out.scene.report.flattened_by_m = flat->at("by_m").get<double>();
    out.scene.report.bent_triangles = whole_at<uint64_t>(*flat, "left_triangles");
    out.scene.report.plane_tolerance_m = flat->at("tolerance_m").get<double>();
  }
  const auto vehicles = whole_at<uint64_t>(json, "vehicles");
  if (vehicles > most_vehicles) throw RuntimeError(name + ": \"vehicles\" is not a number of vehicles");
  out.instances.resize(vehicles);
  for (const Json& input : json.at("inputs"))
    s.inputs.push_back(
        {input.at("name"), input.at("file"), whole_at<uint64_t>(input, "bytes"), whole_at<uint64_t>(input, "hash")});
  if (!check_fits(text))
    throw RuntimeError(name + ": the file is damaged, since its content is not what its key \"check\" says; run again");
  return out;
} catch (const Json::exception& error) {
  throw RuntimeError(fmt::format("{}: this version does not write such a file ({}); run again", name, error.what()));
} catch (const ConfigError& error) {  // a word that this version does not have
  throw RuntimeError(fmt::format("{}: this version does not write such a file ({}); run again", name, error.what()));
}

RunRecord read_run_record(const std::filesystem::path& file) {
  return decode_run_record(read_text(file, most_record_bytes, "every run with shards writes it; run again"),
                           file.string());
}

}  // namespace wavetracer
