// One line of a manifest, of a unit that is the whole run and whose files are the outputs.
#include "jobs/merged_record.hpp"
#include <algorithm>
#include <string>
#include "base/read_text.hpp"
#include "jobs/earlier_run.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t most_merged_bytes = uint64_t{1} << 30;  // it has the seconds of every frame

bool has_length(const fs::path& file, uint64_t bytes) {
  std::error_code error;
  return fs::file_size(file, error) == bytes && !error;
}

}  // namespace

void write_merged_record(const fs::path& directory, const RunIdentity& run, const Totals& totals,
                         std::span<const PendingFile> outputs) {
  Shard whole{run, {run.first, run.last, 0, 1}, totals, {}};
  for (const PendingFile& file : outputs)
    whole.files.push_back({file.path().filename().string(), fs::file_size(file.path())});
  const std::string line = encode_manifest_line(whole);
  PendingFile(merged_record(directory), std::as_bytes(std::span(line))).commit();
}

std::optional<Shard> read_merged_record(const fs::path& directory) {
  const fs::path record = merged_record(directory);
  const std::optional<std::string> text =
      read_text_if_there(record, most_merged_bytes, "check its permissions, or remove it and run again");
  if (!text) return std::nullopt;
  const std::vector<Shard> lines = decode_manifest(*text, record.string(), ManifestOf::outputs);
  const auto is_there = [&](const ShardFile& file) { return has_length(directory / file.name, file.bytes); };
  if (lines.size() != 1 || !std::ranges::all_of(lines[0].files, is_there)) return std::nullopt;
  return lines[0];
}

}  // namespace wavetracer
