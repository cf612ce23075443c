// SPDX-License-Identifier: Apache-2.0
// Files are compared by the keys that name them, which are the same for a copy of the configuration on another machine.
#include "output/inputs.hpp"
#include <fmt/format.h>
#include <algorithm>

namespace wavetracer {
namespace {

// Returns the names of a list, each with the number of times that it came before: two rows of a table may name a file
// by the same key.
std::vector<std::pair<std::string, size_t>> places_of(const std::vector<InputFile>& inputs) {
  std::vector<std::pair<std::string, size_t>> out;
  for (const InputFile& input : inputs)
    out.push_back(
        {input.name, static_cast<size_t>(std::ranges::count(out, input.name, &std::pair<std::string, size_t>::first))});
  return out;
}

}  // namespace

void write_inputs(hdf5::File& file, const std::vector<InputFile>& inputs) {
  const auto group = file.make_group("/inputs", "one row per file that the run has read");
  std::vector<std::string> names, files;
  std::vector<uint64_t> bytes, hashes;
  for (const InputFile& input : inputs) {
    names.push_back(input.name);
    files.push_back(input.file);
    bytes.push_back(input.bytes);
    hashes.push_back(input.hash);
  }
  file.write_strings("/inputs/name",
                     {"1", "key of the config that names it; of a file that this one names its path from there"},
                     names);
  file.write_strings("/inputs/file", {"1", "where it was"}, files);
  hdf5::Rows<uint64_t>(file, "/inputs/bytes", {"1", "its size"}, {inputs.size()}).append(bytes);
  hdf5::Rows<uint64_t>(file, "/inputs/hash", {"1", "hash of its content, by which wavetracer knows that it changed"},
                       {inputs.size()})
      .append(hashes);
}

std::string changed_input(const std::vector<InputFile>& before, const std::vector<InputFile>& now) {
  const auto were = places_of(before), are = places_of(now);
  for (size_t i = 0; i < now.size(); ++i) {
    const auto found = std::ranges::find(were, are[i]);
    if (found == were.end()) return fmt::format("{} ({}) is new", now[i].file, now[i].name);
    const InputFile& was = before[static_cast<size_t>(found - were.begin())];
    if (was.bytes != now[i].bytes || was.hash != now[i].hash)
      return fmt::format("{} ({}) has changed", now[i].file, now[i].name);
  }
  for (size_t i = 0; i < before.size(); ++i)
    if (std::ranges::find(are, were[i]) == are.end())
      return fmt::format("{} ({}) is no longer read", before[i].file, before[i].name);
  return "";
}

}  // namespace wavetracer
