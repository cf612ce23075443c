// SPDX-License-Identifier: Apache-2.0
// Hashes the configuration without its places, and the contents of its inputs. The record of the run that wrote the
// shards (jobs/run_record.hpp) has its configuration and inputs, so that messages can name what differs.
#include "jobs/identity.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "base/hash.hpp"
#include "config/input_files.hpp"
#include "jobs/config_changes.hpp"
#include "jobs/run_record.hpp"
#include "output/inputs.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

std::string hash_of(const std::vector<InputFile>& inputs) {
  std::string text;
  for (const InputFile& input : inputs) text += fmt::format("{}\n{} {}\n", input.name, input.bytes, input.hash);
  return fnv1a_128(text);
}

// Frames of two different worlds must not be mixed.
void check_same_inputs(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder,
                       const std::vector<InputFile>& inputs) {
  if (there.inputs == asked.inputs) return;
  std::error_code none;
  const fs::path record = run_record_in(folder);
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
  const fs::path record = run_record_in(folder);
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

RunIdentity identity_of(const Config& config, const RunSummary& summary, const FrameRange& range) {
  Config elsewhere = config;
  elsewhere.output.directory.clear();  // a folder that was moved still belongs to its run
  // These keys do not affect results.
  elsewhere.output.keep_shards = OutputConfig().keep_shards;
  elsewhere.output.compression = OutputConfig().compression;
  // Places of inputs do not count, contents do.
  for (const config::NamedFile& file : config::input_files(elsewhere)) file.path->clear();
  return {summary.version,
          fnv1a_128(resolved_config(elsewhere)),
          summary.device.gpu ? "gpu" : "cpu",
          range.first,
          range.last,
          summary.repeat_count,
          hash_of(summary.inputs)};
}

void check_same_run(const RunIdentity& there, const RunIdentity& asked, const fs::path& folder,
                    const std::string& config, const std::vector<InputFile>& inputs) {
  check_same_keys(there, asked, folder, config);
  check_same_inputs(there, asked, folder, inputs);
}

}  // namespace wavetracer
