// SPDX-License-Identifier: Apache-2.0
// Fuzz target: a part of a run from elsewhere, as `wavetracer merge` reads it. The HDF5 library may crash in a separate
// process: see LimitedChild. To fork one for each input takes most of the time, so 200 inputs share a process, in which
// they are read as own parts are. After a fault there, the input is merged again as the program does it. An input that
// fails among others is given to libFuzzer as the next one, so that libFuzzer keeps it.
#include <dlfcn.h>
#include <fmt/format.h>
#include <cstring>
#include <fstream>
#include <iostream>
#include <optional>
#include <thread>
#include <vector>
#include "base/hash.hpp"
#include "fuzz/children.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/worker.hpp"
#include "jobs/merge_folders.hpp"
#include "jobs/shards.hpp"
#include "output/hdf5.hpp"
#include "output/sample_run.hpp"

namespace {

using namespace wavetracer;
using fuzz::End;
namespace fs = std::filesystem;

// A finished part whose paths.h5 any input replaces.
class Part {
 public:
  // A child makes the part, since this process must have no threads.
  Part() : folder_("/dev/shm/wavetracer-fuzz-part-" + std::to_string(getpid())) {
    fuzz::Worker maker(nullptr, [this](std::string_view) { return make(); });
    if (maker.run(std::string()) != End::answer) std::abort();
    manifest_ = manifests_in(folder_ / "shards").at(0);
    shard_ = read_manifest(manifest_).at(0);
  }
  ~Part() { fs::remove_all(folder_); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  // It is called in forked processes alone.
  void merge_with(std::string_view content, Parts whose) {
    shard_.files[0].bytes = content.size();
    const fs::path part = folder_ / "shards" / shard_.files[0].name;
    fs::remove(part);  // the library takes a file for one that it has left open if it is at the same place of the disk
    std::ofstream(part, std::ios::binary) << content;
    shard_.files[0].hash = content_hash(part).value();
    std::ofstream(manifest_) << encode_manifest_line(shard_);
    merge_found(find_parts({folder_}), folder_ / "out", "", whose);
  }

 private:
  bool make() const {
    const SampleRun sample;
    Shards shards(folder_, {"1.2.3", "0123", "cpu", 7, 8, 1});
    shards.share("0_of_1", true);
    shards.write(sample.run(), sample.drive(7, 2));
    return true;
  }

  fs::path folder_, manifest_;
  Shard shard_;
};

// While it is set, threads run at once and end before they are joined: a thread for a few microseconds of work waits
// for the processor longer than it runs.
bool no_threads = false;

template <class Function>
Function of_libstdcxx(const char* name) {
  const auto out = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  if (!out) std::abort();
  return out;
}

class Merges {
 public:
  Merges() = default;
  ~Merges() {
    finish();
    if (failing_) keep(*failing_);
  }
  Merges(const Merges&) = delete;
  Merges& operator=(const Merges&) = delete;

  // Merges the input at once, or later together with others.
  void run(std::string_view input) {
    waiting_.emplace_back(input);
    if (std::exchange(failed_before_, false)) fail_again();
    if (std::exchange(at_once_, always_at_once_) || waiting_.size() == fuzz::Worker::most_inputs) finish();
  }
  // Returns the input that must be the next one, if there is one, of `most` bytes at most: it failed, or it reached
  // something new, while it was merged with others. libFuzzer takes the last input of a call for the one that did it.
  std::string take_next(size_t most) {
    always_at_once_ = false;
    if (!failing_ && new_.empty()) return "";
    finish();
    at_once_ = true;
    if (failing_) {
      if (failing_->size() > most) keep(*failing_);
      failed_before_ = true;
      return *std::exchange(failing_, {});
    }
    std::string input = std::move(new_.back());
    new_.pop_back();
    return input.size() > most ? "" : input;
  }
  void finish() {
    std::vector<std::string> inputs = std::exchange(waiting_, {});
    for (std::span<std::string> rest = inputs; !rest.empty();) {
      const End end = together_.run(rest);
      const size_t tried = together_.tried();
      for (size_t i = 0; i < tried && inputs.size() > 1; ++i)
        if (together_.is_new(i)) new_.push_back(rest[i]);
      if (end != End::answer && end != End::remains && !holds(rest.first(tried), end) && inputs.size() == 1)
        std::abort();
      rest = rest.subspan(tried);
    }
  }

 private:
  // Tells whether a process that ended so by the last of these inputs is no finding.
  bool holds(std::span<const std::string> inputs, End end) {
    if (inputs.empty()) std::abort();
    if (as_program_.run(inputs.back()) != End::answer) return fails(inputs.back());
    if (end != End::elsewhere) return true;
    for (const std::string& input : inputs)
      if (alone_.run(input) == End::elsewhere) return fails(input);
    // The library has damaged the memory of the process before.
    std::cerr << fmt::format("{} inputs ended a process that one alone does not end\n", inputs.size());
    return true;
  }
  bool fails(const std::string& input) {
    if (!failing_) failing_ = input;
    return false;
  }
  void fail_again() {
    if (as_program_.run(waiting_.back()) == End::answer && alone_.run(waiting_.back()) != End::elsewhere)
      keep(waiting_.back());
    std::abort();
  }
  // For an input that libFuzzer cannot keep.
  [[noreturn]] static void keep(std::string_view input) {
    const std::string file = fmt::format("/dev/shm/wavetracer-fuzz-merge-{}.h5", getpid());
    std::ofstream(file, std::ios::binary) << input;
    std::cerr << "the input that fails: " << file << '\n';
    std::abort();
  }
  bool merge(std::string_view input, Parts whose) {
    fuzz::accept_or_refuse([&] { part_.merge_with(input, whose); });
    return H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0;  // the library keeps open what it cannot close
  }

  Part part_;
  std::vector<std::string> waiting_, new_;
  std::optional<std::string> failing_;
  bool failed_before_ = false;                   // the next input is one that has failed among others
  bool always_at_once_ = true, at_once_ = true;  // until libFuzzer asks for an input: it begins with its corpus
  const void* library_ = reinterpret_cast<const void*>(&H5open);
  fuzz::Worker::Try try_ = [this](std::string_view input) {
    no_threads = true;  // in this child
    return merge(input, Parts::own);
  };
  fuzz::Worker together_{library_, try_}, alone_{library_, try_};
  fuzz::Worker as_program_{library_, [this](std::string_view input) {
                             fuzz::tame_children();
                             return merge(input, Parts::foreign);
                           }};
};

Merges& merges() {
  static Merges merges;
  return merges;
}

}  // namespace

// These two stand before the functions of libstdc++.
void std::thread::_M_start_thread(_State_ptr work, void (*depend)()) {
  using Start = void (*)(std::thread*, _State_ptr*, void (*)());
  static const auto start =
      of_libstdcxx<Start>("_ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE");
  if (no_threads) return work->_M_run();
  start(this, &work, depend);
}
void std::thread::join() {
  static const auto join = of_libstdcxx<void (*)(std::thread*)>("_ZNSt6thread4joinEv");
  if (!no_threads) join(this);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  merges().run(fuzz::text_of(data, size));
  return 0;
}

extern "C" __attribute__((weak)) size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned) {
  const std::string input = merges().take_next(most);
  if (input.empty()) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, input.data(), input.size());
  return input.size();
}
