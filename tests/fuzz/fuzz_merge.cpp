// Fuzz target: a part of a run from elsewhere, as `wavetracer merge` reads it. The HDF5 library may fault where the file
// is rehearsed, and nowhere else.
#include <fstream>
#include "fuzz/fuzz.hpp"
#include "fuzz/rehearsal.hpp"
#include "output/h5_outputs.hpp"
#include "output/hdf5_read.hpp"
#include "output/merge_folders.hpp"
#include "output/merge_outputs.hpp"
#include "output/sample_run.hpp"
#include "output/shards.hpp"

namespace {

using namespace wavetracer;
namespace fs = std::filesystem;

// A finished part whose paths.h5 any input replaces.
class Part {
 public:
  Part() : folder_("/dev/shm/wavetracer-fuzz-part-" + std::to_string(getpid())) {
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

  fs::path file() const { return folder_ / "shards" / shard_.files[0].name; }

  void merge_with(std::string_view content) {
    shard_.files[0].bytes = content.size();
    std::ofstream(file(), std::ios::binary) << content;
    std::ofstream(manifest_) << encode_manifest_line(shard_);
    merge_found(find_parts({folder_}), folder_ / "out", "");
  }

 private:
  fs::path folder_, manifest_;
  Shard shard_;
};

Part& part() {
  static Part part;
  return part;
}

void read_part() {  // as merge_folders.cpp rehearses it
  const H5Output& output = h5_outputs({})[0];
  check_parts(output, {part().file()});
  hdf5::File head;
  copy_head(part().file(), output, head);
}

}  // namespace

void wavetracer::hdf5::rehearse(const std::function<void()>&) {
  static fuzz::Rehearsal rehearsal(read_part);
  if (!rehearsal.survived()) throw RuntimeError("the file is damaged");
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::accept_or_refuse([&] { part().merge_with(fuzz::text_of(data, size)); });
}
