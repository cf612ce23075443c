// SPDX-License-Identifier: Apache-2.0
// DIR/shards/run.json: the facts about a run beyond its frames, so that `wavetracer merge` can write summary.json
// without a device, the scene, or the configuration's files.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include "wavetracer/output.hpp"

namespace wavetracer {

// The part of a Run that summary.json is made of.
struct RunRecord {
  Config config;
  Scene scene;
  std::vector<Instance> instances;
  std::vector<Scene> models;
  RunSummary summary;
  Run run() const { return {config, scene, instances, models, summary}; }
};

// Returns the path of the record in this folder of shards.
inline std::filesystem::path run_record_in(const std::filesystem::path& shards) { return shards / "run.json"; }

std::string encode_run_record(const Run& run);
// text: any bytes. Throws RuntimeError that begins with `name`.
RunRecord decode_run_record(std::string_view text, const std::string& name);
RunRecord read_run_record(const std::filesystem::path& file);

}  // namespace wavetracer
