// The rules by which PoCL chooses its folder (pocl_cache_init_topdir): POCL_CACHE_DIR, XDG_CACHE_HOME, HOME, /tmp.
// Nothing is created but the folder that this process chooses itself, which must be this user's alone: PoCL runs what
// lies in its cache.
#include "gpu/pocl.hpp"
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include "base/environment.hpp"

namespace wavetracer::gpu {

namespace {

namespace fs = std::filesystem;

// Why the folder, or the nearest one above it that exists, cannot be written to; empty where it can.
std::string obstacle(fs::path folder) {
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, error)) return folder.string() + " is no folder";
  if (access(folder.c_str(), W_OK | X_OK) != 0) return fmt::format("{}: {}", folder.string(), std::strerror(errno));
  return {};
}

// A folder that nobody else can write to, made where it is missing; empty where that cannot be had.
fs::path own_folder() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error) / fmt::format("wavetracer-pocl-{}", getuid());
  if (error) return {};
  mkdir(folder.c_str(), 0700);
  struct stat status = {};
  const bool own = lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == getuid() &&
                   (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  return own && obstacle(folder).empty() ? folder : fs::path();
}

}  // namespace

fs::path pocl_cache_folder() {
  if (const std::string chosen = environment("POCL_CACHE_DIR"); !chosen.empty()) return chosen;
  if (const std::string caches = environment("XDG_CACHE_HOME"); !caches.empty())
    return fs::path(caches) / "pocl/kcache";
  if (const std::string home = environment("HOME"); !home.empty()) return fs::path(home) / ".cache/pocl/kcache";
  return "/tmp/pocl/kcache";
}

void give_pocl_a_cache() {
  if (!environment("POCL_CACHE_DIR").empty()) return;
  unsetenv("POCL_CACHE_DIR");  // PoCL takes an empty one for a folder
  if (pocl_cache_problem().empty()) return;
  if (const fs::path folder = own_folder(); !folder.empty()) setenv("POCL_CACHE_DIR", folder.c_str(), 1);
}

std::string pocl_cache_problem() {
  const std::string why = obstacle(fs::absolute(pocl_cache_folder()));
  if (why.empty()) return {};
  return fmt::format(
      "PoCL, the OpenCL of CPUs, cannot write its cache ({}) and then offers no device: set POCL_CACHE_DIR to a folder "
      "that can be written to",
      why);
}

}  // namespace wavetracer::gpu
