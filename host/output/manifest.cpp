// JSON both ways. A line counts once its line end is there.
// Assumes that only this program writes manifests; what is not understood is an error, not a guess.
#include "output/manifest.hpp"
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include "output/cache_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Json = nlohmann::ordered_json;

Shard decode(const Json& json) {
  Shard shard;
  const Json& run = json.at("run");
  shard.run = {run.at("version"), run.at("config"), run.at("device_kind"),
               run.at("first"),   run.at("last"),   run.at("repeat")};
  Totals& t = shard.totals;
  t.first = json.at("first");
  t.last = json.at("last");
  t.frames = uint64_t{t.last} - t.first + 1;
  t.start_s = json.at("start_s");
  t.end_s = json.at("end_s");
  t.vertices = json.at("vertices");
  t.links = json.at("links");
  const Json& counts = json.at("counts");
  t.counts = {counts.at("rays"),       counts.at("segments"), counts.at("hits"), counts.at("sequences"),
              counts.at("candidates"), counts.at("solved"),   counts.at("paths"), counts.at("receptions")};
  t.kinds = json.at("kinds").get<PathKindCounts>();
  t.segments_per_depth = json.at("segments_per_depth").get<std::vector<uint64_t>>();
  if (json.contains("cache")) t.cache = decode_cache(json.at("cache"));
  t.seconds = json.at("seconds").get<std::map<std::string, std::vector<double>>>();
  t.warnings = json.at("warnings").get<std::vector<std::string>>();
  for (const Json& file : json.at("files")) shard.files.push_back({file.at("name"), file.at("bytes")});
  return shard;
}

}  // namespace

std::string encode_manifest_line(const Shard& shard) {
  const RunIdentity& run = shard.run;
  const Totals& t = shard.totals;
  Json files = Json::array();
  for (const ShardFile& file : shard.files) files.push_back({{"name", file.name}, {"bytes", file.bytes}});
  Json json;
  json["first"] = t.first;
  json["last"] = t.last;
  json["start_s"] = t.start_s;
  json["end_s"] = t.end_s;
  json["vertices"] = t.vertices;
  json["links"] = t.links;
  json["counts"] = {{"rays", t.counts.rays},           {"segments", t.counts.segments},
                    {"hits", t.counts.hits},           {"sequences", t.counts.sequences},
                    {"candidates", t.counts.candidates}, {"solved", t.counts.solved},
                    {"paths", t.counts.paths},         {"receptions", t.counts.receptions}};
  json["kinds"] = t.kinds;  // in the order of path_kinds
  json["segments_per_depth"] = t.segments_per_depth;
  if (t.cache.on) json["cache"] = encode_cache(t.cache);
  json["seconds"] = t.seconds;
  json["warnings"] = t.warnings;
  json["files"] = files;
  json["run"] = {{"version", run.version}, {"config", run.config}, {"device_kind", run.device_kind},
                 {"first", run.first},     {"last", run.last},     {"repeat", run.repeat}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Shard> read_manifest(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  std::ifstream in(file, std::ios::binary);
  if (!in) throw RuntimeError(fmt::format("cannot read {}; check its permissions", file.string()));
  std::vector<Shard> shards;
  std::string line;
  for (size_t number = 1; std::getline(in, line) && !in.eof(); ++number) {
    try {
      shards.push_back(decode(Json::parse(line)));
    } catch (const Json::exception& error) {
      if (in.peek() == std::ifstream::traits_type::eof()) break;
      throw RuntimeError(fmt::format("{}:{}: not a line that this version writes ({}); run again without --resume",
                                     file.string(), number, error.what()));
    }
  }
  return shards;
}

}  // namespace wavetracer
