// SPDX-License-Identifier: Apache-2.0
// A copy of the project's kernels from which the device's programs are made, so that a test may break a line of one;
// with a cache of programs of its own.
#pragma once
#include <doctest/doctest.h>

#include "gpu/temporary.hpp"

namespace wavetracer::test {

class KernelsCopy {
 public:
  KernelsCopy() {
    give_pocl_a_lasting_cache();
    for (const char* part : {"kernels", "include"})
      std::filesystem::copy(std::filesystem::path(source_folder()) / part, folder_.path() / part,
                            std::filesystem::copy_options::recursive);
  }
  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path kernels() const { return folder_.path() / "kernels"; }

 private:
  TemporaryFolder folder_;
};

// There is one copy for the whole program: sources name their files, so a copy in another folder would be compiled
// again.
inline const KernelsCopy& kernels_copy() {
  static const KernelsCopy copy;
  return copy;
}

// While it exists, a line of a file of the copy is replaced.
class BrokenLine {
 public:
  BrokenLine(const std::string& file, const std::string& right, const std::string& wrong)
      : path_(kernels_copy().path() / file), text_(read_file(path_)) {
    const size_t at = text_.find(right);
    REQUIRE(at != std::string::npos);
    write_file(path_, std::string(text_).replace(at, right.size(), wrong));
  }
  ~BrokenLine() { write_file(path_, text_); }
  BrokenLine(const BrokenLine&) = delete;
  BrokenLine& operator=(const BrokenLine&) = delete;

 private:
  std::filesystem::path path_;
  std::string text_;
};

// While it exists, programs are compiled from the copy and kept in a folder of the test's own.
class CopyInUse {
 public:
  std::filesystem::path programs() const { return cache_.path() / "wavetracer" / "programs"; }

 private:
  TemporaryFolder cache_;
  Environment kernel_dir_{"WAVETRACER_KERNEL_DIR", kernels_copy().kernels().c_str()};
  Environment cache_home_{"XDG_CACHE_HOME", cache_.path().c_str()};
  Environment use_cache_{"WAVETRACER_NO_CACHE", nullptr};
};

}  // namespace wavetracer::test
