// SPDX-License-Identifier: Apache-2.0
// Temporary objects of tests: a folder, an environment variable, a folder of kernels. They are not thread-safe, as the
// environment is not.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include "contains.hpp"
#include "folders.hpp"
#include "temporary_folder.hpp"

namespace wavetracer::test {

// Sets a variable, or unsets it if value is null, and restores the former value.
class Environment {
 public:
  Environment(std::string name, const char* value) : name_(std::move(name)) {
    if (const char* old = std::getenv(name_.c_str())) old_ = old;
    set(value);
  }
  ~Environment() { set(old_ ? old_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) {
    if (value) {
      ::setenv(name_.c_str(), value, 1);
    } else {
      ::unsetenv(name_.c_str());
    }
  }
  std::string name_;
  std::optional<std::string> old_;
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

// PoCL reads the place of its own cache of kernels once per process, from XDG_CACHE_HOME unless POCL_CACHE_DIR is set,
// and expects it to stay. This must be called before the first use of OpenCL.
inline void give_pocl_a_lasting_cache() {
  static const TemporaryFolder folder;
  ::setenv("POCL_CACHE_DIR", folder.path().c_str(), 0);
}

// A kernels folder of the test's own (WAVETRACER_KERNEL_DIR), with the project's device headers beside it,
// and a program cache of its own (XDG_CACHE_HOME).
class TemporaryKernels {
 public:
  TemporaryKernels() {
    give_pocl_a_lasting_cache();
    std::filesystem::create_directory(kernels());
    std::filesystem::create_directory_symlink(std::filesystem::path(test::source_folder()) / "include",
                                              folder_.path() / "include");
  }
  std::filesystem::path kernels() const { return folder_.path() / "kernels"; }
  std::filesystem::path cache() const { return folder_.path() / "cache"; }
  void add(const std::string& name, const std::string& text) const { write_file(kernels() / name, text); }

 private:
  TemporaryFolder folder_;
  Environment kernel_dir_{"WAVETRACER_KERNEL_DIR", kernels().c_str()};
  Environment cache_home_{"XDG_CACHE_HOME", cache().c_str()};
  Environment use_cache_{"WAVETRACER_NO_CACHE", nullptr};
};

// Returns the message of an exception of type E; empty if none was thrown.
template <class E, class F>
std::string message_of(F&& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

}  // namespace wavetracer::test
