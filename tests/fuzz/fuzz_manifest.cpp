// SPDX-License-Identifier: Apache-2.0
// Fuzz target: manifests of the parts of a run. An accepted manifest must be accepted again after it was written out.
#include "fuzz/fuzz.hpp"
#include "jobs/manifest.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  std::vector<Shard> shards;
  fuzz::accept_or_refuse([&] { shards = decode_manifest(fuzz::text_of(data, size), "manifest.jsonl"); });
  for (const Shard& shard : shards) {
    const std::string line = encode_manifest_line(shard);
    const std::vector<Shard> again = decode_manifest(line, "again.jsonl");
    if (again.size() != 1 || encode_manifest_line(again[0]) != line) std::abort();
  }
  return 0;
}
