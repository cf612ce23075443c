// SPDX-License-Identifier: Apache-2.0
// Fuzz target: a part of a run from elsewhere, as `wavetracer merge` reads it. The HDF5 library may crash in a separate
// process: see LimitedChild.
#include <fstream>
#include "base/hash.hpp"
#include "fuzz/children.hpp"
#include "fuzz/fuzz.hpp"
#include "jobs/merge_folders.hpp"
#include "jobs/shards.hpp"
#include "output/sample_run.hpp"

namespace {

using namespace wavetracer;
namespace fs = std::filesystem;

// A finished part whose paths.h5 any input replaces.
class Part {
 public:
  Part() : folder_("/dev/shm/wavetracer-fuzz-part-" + std::to_string(getpid())) {
    fuzz::tame_children();
    const SampleRun sample;
    Shards shards(folder_, {"1.2.3", "0123", "cpu", 7, 8, 1});
    shards.share("0_of_1", true);
    shards.write(sample.run(), sample.drive(7, 2));
    manifest_ = manifests_in(folder_ / "shards").at(0);
    shard_ = read_manifest(manifest_).at(0);
  }
  ~Part() { fs::remove_all(folder_); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void merge_with(std::string_view content) {
    shard_.files[0].bytes = content.size();
    const fs::path part = folder_ / "shards" / shard_.files[0].name;
    std::ofstream(part, std::ios::binary) << content;
    shard_.files[0].hash = content_hash(part).value();
    std::ofstream(manifest_) << encode_manifest_line(shard_);
    merge_found(find_parts({folder_}), folder_ / "out", "");
  }

 private:
  fs::path folder_, manifest_;
  Shard shard_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static Part part;
  return fuzz::accept_or_refuse([&] { part.merge_with(fuzz::text_of(data, size)); });
}
