// SPDX-License-Identifier: Apache-2.0
// Hashes the configuration without its places, and the contents of its inputs.
#include "jobs/identity.hpp"
#include <fmt/format.h>
#include "base/hash.hpp"
#include "config/input_files.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer {
namespace {

std::string hash_of(const std::vector<InputFile>& inputs) {
  std::string text;
  for (const InputFile& input : inputs) text += fmt::format("{}\n{} {}\n", input.name, input.bytes, input.hash);
  return fnv1a_128(text);
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

}  // namespace wavetracer
