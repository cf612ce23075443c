// SPDX-License-Identifier: Apache-2.0
// Converts to and from JSON. A line counts once it has its line end.
// Only this program writes manifests, so a line that is not understood is an error.
#include "jobs/manifest.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include "base/file.hpp"
#include "base/json_whole.hpp"
#include "jobs/checked_text.hpp"
#include "output/cache_json.hpp"
#include "output/h5_outputs.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr uint64_t most_manifest_bytes = uint64_t{1} << 32;

[[noreturn]] void refuse(const std::string& what) { throw Json::other_error::create(501, what, nullptr); }

// Names must be those of files in the folder.
void check_outputs(const Shard& whole) {
  for (const ShardFile& file : whole.files)
    if (file.name.empty() || file.name.find('/') != std::string::npos) refuse("\"" + file.name + "\" is no output");
}

void check_files(const Shard& shard) {
  const std::string stem = unit_name(shard.unit) + ".";
  if (shard.files.size() < 2 || shard.files.size() > most_h5_outputs + 1)
    refuse("the names of its files are not those of a shard");
  for (const ShardFile& file : shard.files)
    if (!file.name.starts_with(stem) || file.name.find('/') != std::string::npos)
      refuse("\"" + file.name + "\" does not belong to this shard");
}

Json encode_missed(const MissedCounts& missed) {
  return {{"frames", missed.frames}, {"unknown", missed.unknown},     {"paths", missed.paths},
          {"powers", missed.powers}, {"amplitude", missed.amplitude}, {"power", missed.power}};
}

Json encode_certificate(const Certificate& of) {
  Json json = {{"frames", of.frames},
               {"depth", of.depth},
               {"any_depth", of.any_depth},
               {"edges", of.edges},
               {"ends", of.ends},
               {"left_out_sr", of.left_out_sr},
               {"left_out_power", of.left_out_power},
               {"weak_sr", of.weak_sr}};
  if (of.floor_db) json["floor_db"] = *of.floor_db;
  return json;
}

Certificate decode_certificate(const Json& json) {
  Certificate out{.frames = whole_at<uint64_t>(json, "frames"),
                  .depth = whole_at<uint32_t>(json, "depth"),
                  .edges = whole_at<uint32_t>(json, "edges"),
                  .any_depth = json.at("any_depth"),
                  .ends = whole_at<uint64_t>(json, "ends"),
                  .left_out_sr = json.at("left_out_sr"),
                  .left_out_power = json.at("left_out_power"),
                  .weak_sr = json.at("weak_sr")};
  if (json.contains("floor_db")) out.floor_db = json.at("floor_db");
  return out;
}

MissedCounts decode_missed(const Json& json) {
  MissedCounts out;
  out.frames = whole_at<uint64_t>(json, "frames");
  if (json.contains("unknown")) out.unknown = whole_at<uint64_t>(json, "unknown");
  const std::vector<uint64_t> paths = whole_list<uint64_t>(json, "paths");
  if (paths.size() != out.paths.size()) refuse("the counts of paths of the four quarters of a launch are wrong");
  std::ranges::copy(paths, out.paths.begin());
  if (json.at("powers").size() != out.powers.size())
    refuse("the powers of paths of the four quarters of a launch are wrong");
  out.powers = json.at("powers");
  out.amplitude = json.at("amplitude");
  out.power = json.at("power");
  return out;
}

FrameCounts decode_counts(const Json& json) {
  FrameCounts out;
  for (const auto& [name, count, optional] : frame_count_names)
    out.*count = optional ? whole_or<uint64_t>(json, name, 0) : whole_at<uint64_t>(json, name);
  return out;
}

Shard decode(const Json& json, ManifestOf what) {
  Shard shard;
  const Json& run = json.at("run");
  shard.run = {run.at("version"),
               run.at("config"),
               run.at("device_kind"),
               whole_at<uint32_t>(run, "first"),
               whole_at<uint32_t>(run, "last"),
               whole_at<uint32_t>(run, "repeat"),
               run.at("inputs")};
  Totals& t = shard.totals;
  t.first = whole_at<uint32_t>(json, "first");
  t.last = whole_at<uint32_t>(json, "last");
  if (t.first > t.last || t.first < shard.run.first || t.last > shard.run.last)
    refuse("its frames are not among those of the run");
  shard.unit = {t.first, t.last, 0, 1};
  if (json.contains("blocks")) {
    shard.unit.block = whole_at<uint32_t>(json, "block");
    shard.unit.blocks = whole_at<uint32_t>(json, "blocks");
    if (shard.unit.block >= shard.unit.blocks || t.first != t.last) refuse("its block of links cannot exist");
  }
  t.frames = uint64_t{t.last} - t.first + 1;
  t.start_s = json.at("start_s");
  t.end_s = json.at("end_s");
  t.vertices = whole_at<uint64_t>(json, "vertices");
  t.links = whole_at<uint64_t>(json, "links");
  t.counts = decode_counts(json.at("counts"));
  const std::vector<uint64_t> kinds = whole_list<uint64_t>(json, "kinds");
  if (kinds.size() != t.kinds.size()) refuse("its kinds of paths are not those of this version");
  std::ranges::copy(kinds, t.kinds.begin());
  t.segments_per_depth = whole_list<uint64_t>(json, "segments_per_depth");
  if (json.contains("left_out")) {
    const Json& gone = json.at("left_out");
    t.left_out = {whole_at<uint64_t>(gone, "paths"), gone.at("power"), gone.at("all")};
  }
  t.left_out_at_edges = json.value("left_out_at_edges", 0.0);
  if (json.contains("missed")) t.missed = decode_missed(json.at("missed"));
  if (json.contains("certificate")) t.certificate = decode_certificate(json.at("certificate"));
  if (json.contains("late")) {
    const Json& late = json.at("late");
    t.late = {whole_at<uint64_t>(late, "discoveries"), whole_at<uint64_t>(late, "paths"), late.at("power"),
              late.at("all"), late.at("largest_share")};
  }
  if (json.contains("cache")) t.cache = decode_cache(json.at("cache"));
  t.timed_segments = whole_or<uint64_t>(json, "timed_segments", 0);
  t.seconds = json.at("seconds").get<std::map<std::string, std::vector<double>>>();
  t.warnings = json.at("warnings").get<std::vector<std::string>>();
  if (json.contains("missing")) {
    const Json& missing = json.at("missing");
    t.missing = {whole_at<uint64_t>(missing, "links"), whole_at<uint64_t>(missing, "in_grids"),
                 missing.at("why").get<std::vector<std::string>>(),
                 missing.at("why_in_grids").get<std::vector<std::string>>()};
  }
  for (const Json& file : json.at("files"))
    shard.files.push_back({file.at("name"), whole_at<uint64_t>(file, "bytes"), whole_at<uint64_t>(file, "hash")});
  what == ManifestOf::shards ? check_files(shard) : check_outputs(shard);
  return shard;
}

}  // namespace

std::string encode_manifest_line(const Shard& shard) {
  const RunIdentity& run = shard.run;
  const Totals& t = shard.totals;
  Json files = Json::array();
  for (const ShardFile& file : shard.files)
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"hash", file.hash}});
  Json json;
  json["first"] = t.first;
  json["last"] = t.last;
  if (shard.unit.blocks > 1) {
    json["block"] = shard.unit.block;
    json["blocks"] = shard.unit.blocks;
  }
  json["start_s"] = t.start_s;
  json["end_s"] = t.end_s;
  json["vertices"] = t.vertices;
  json["links"] = t.links;
  for (const auto& [name, count, optional] : frame_count_names)
    if (!optional || t.counts.*count > 0) json["counts"][name] = t.counts.*count;
  json["kinds"] = t.kinds;  // in the order of path_kinds
  json["segments_per_depth"] = t.segments_per_depth;
  if (t.left_out.all > 0)
    json["left_out"] = {{"paths", t.left_out.paths}, {"power", t.left_out.power}, {"all", t.left_out.all}};
  if (t.left_out_at_edges > 0) json["left_out_at_edges"] = t.left_out_at_edges;
  if (t.missed.frames + t.missed.unknown > 0) json["missed"] = encode_missed(t.missed);
  if (t.certificate.frames > 0) json["certificate"] = encode_certificate(t.certificate);
  if (t.late.discoveries > 0)
    json["late"] = {{"discoveries", t.late.discoveries},
                    {"paths", t.late.paths},
                    {"power", t.late.power},
                    {"all", t.late.all},
                    {"largest_share", t.late.largest_share}};
  if (t.cache.on) json["cache"] = encode_cache(t.cache);
  json["timed_segments"] = t.timed_segments;
  json["seconds"] = t.seconds;
  json["warnings"] = t.warnings;
  if (!t.missing.empty())
    json["missing"] = {{"links", t.missing.links},
                       {"in_grids", t.missing.in_grids},
                       {"why", t.missing.why},
                       {"why_in_grids", t.missing.why_in_grids}};
  json["files"] = files;
  json["run"] = {{"version", run.version}, {"config", run.config}, {"device_kind", run.device_kind},
                 {"first", run.first},     {"last", run.last},     {"repeat", run.repeat},
                 {"inputs", run.inputs}};
  return with_check(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

std::vector<Shard> decode_manifest(std::string_view text, const std::string& name, ManifestOf what) {
  std::vector<Shard> shards;
  for (size_t number = 1; !text.empty(); ++number) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) break;  // the line is incomplete
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    try {
      Shard shard = decode(Json::parse(line), what);
      if (!check_fits(line)) refuse("it is damaged: its content is not what its key \"check\" says");
      shards.push_back(std::move(shard));
    } catch (const Json::exception& error) {
      if (text.empty()) break;
      throw RuntimeError(
          fmt::format("{}:{}: this version does not write such a line ({}); remove the file and run again, "
                      "or run without --resume",
                      name, number, error.what()));
    }
  }
  return shards;
}

std::vector<Shard> read_manifest(const fs::path& file) {
  const std::optional<std::string> text =
      read_text_if_there(file, most_manifest_bytes, "check its permissions, or remove it and run again");
  return text ? decode_manifest(*text, file.string()) : std::vector<Shard>();
}

std::vector<Shard> NewLines::read() {
  std::vector<Shard> shards;
  for (const fs::path& file : manifests_in(folder_)) {
    std::error_code none;
    const uint64_t size = fs::file_size(file, none);
    uint64_t& done = done_[file];
    if (none || size <= done || size > most_manifest_bytes) continue;
    std::string text(size - done, '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.seekg(static_cast<std::streamoff>(done)).read(text.data(), static_cast<std::streamsize>(text.size())))
      continue;
    text.erase(text.rfind('\n') + 1);  // removes a line without a line end
    done += text.size();
    std::ranges::move(decode_manifest(text, file.string()), std::back_inserter(shards));
  }
  return shards;
}

std::vector<fs::path> manifests_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("manifest.") && name.ends_with(".jsonl")) out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace wavetracer
