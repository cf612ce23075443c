// SPDX-License-Identifier: Apache-2.0
// run.json, the record of the run that wrote the shards, has its configuration and inputs, so that messages can name
// them.
#include "jobs/same_run.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "jobs/config_changes.hpp"
#include "jobs/run_record.hpp"
#include "output/inputs.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

const char* const run_record_name = "run.json";

// Frames of two different worlds must not be mixed.
void check_same_inputs(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder,
                       const std::vector<InputFile>& inputs) {
  if (there.inputs == asked.inputs) return;
  std::error_code none;
  const fs::path record = folder / run_record_name;
  std::string which;
  if (fs::exists(record, none)) which = changed_input(read_run_record(record).summary.inputs, inputs);
  throw InputError(
      fmt::format("{} since the shards in {} were written; put the input files back as they were, "
                  "or choose another folder with -o, or remove the shards",
                  which.empty() ? "an input file has changed" : which, folder.string()));
}

// Returns the keys that differ, by the record of the run that wrote the shards; empty if the record does not tell.
std::string changed_keys(const fs::path& folder, const std::string& config) {
  constexpr size_t shown = 5;
  std::error_code none;
  const fs::path record = folder / run_record_name;
  if (config.empty() || !fs::exists(record, none)) return "";
  const std::string before = read_run_record(record).config.text;
  if (before.empty()) return "";
  const std::vector<std::string> changes = config_changes(before, config);
  std::string out;
  for (size_t i = 0; i < std::min(changes.size(), shown); ++i) out += (i ? "; " : "") + changes[i];
  if (changes.size() > shown) out += fmt::format("; and {} more keys", changes.size() - shown);
  return out;
}

void check_same_keys(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder,
                     const std::string& config) {
  if (there.version == asked.version && there.config != asked.config)
    if (const std::string keys = changed_keys(folder, config); !keys.empty())
      throw ConfigError(
          fmt::format("the shards in {} were written with another configuration: {}; run it as before, "
                      "or choose another folder with -o, or remove the shards",
                      folder.string(), keys));
  const auto differs = [&](const std::string& what, const auto& was, const auto& is) {
    if (was != is)
      throw ConfigError(
          fmt::format("the shards in {} were written with {} {}, this run has {}; run it as before, "
                      "or choose another folder with -o, or remove the shards",
                      folder.string(), what, was, is));
  };
  differs("version", there.version, asked.version);
  differs("a configuration whose hash is", there.config, asked.config);
  differs("a device of kind", there.device_kind, asked.device_kind);
  differs("--frames", fmt::format("{}:{}", there.first, there.last), fmt::format("{}:{}", asked.first, asked.last));
  differs("--repeat", there.repeat, asked.repeat);
}

}  // namespace

void check_same_run(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder,
                    const std::string& config, const std::vector<InputFile>& inputs) {
  check_same_keys(there, asked, folder, config);
  check_same_inputs(there, asked, folder, inputs);
}

}  // namespace wavetracer
