// SPDX-License-Identifier: Apache-2.0
// Follows the rules by which PoCL chooses its folder (pocl_cache_init_topdir): POCL_CACHE_DIR, XDG_CACHE_HOME, HOME,
// /tmp. It creates only the folder that this process chooses itself, which must belong to this user alone: PoCL runs
// the code that lies in its cache.
#include "gpu/pocl.hpp"
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cstdlib>
#include <fstream>
#include <string>
#include "base/environment.hpp"
#include "base/output_place.hpp"

namespace wavetracer::gpu {

namespace {

namespace fs = std::filesystem;

constexpr uint64_t least_room = uint64_t{16} << 20;  // bytes; the kernels of a run take some megabytes

// Returns why PoCL cannot keep its cache in the folder, or empty if it can. PoCL ends the process if the disk becomes
// full.
std::string obstacle(const fs::path& folder) {
  if (std::string why = write_obstacle(folder); !why.empty()) return why;
  std::error_code error;
  const fs::path there = nearest_existing(folder, error);
  const fs::space_info space = fs::space(there, error);
  if (error || space.available >= least_room) return "";
  return fmt::format("{}: {} KiB are left, and {} MiB may be needed", there.string(), space.available >> 10,
                     least_room >> 20);
}

// Returns a folder that no other user can write to, and makes it if missing; empty if that fails.
fs::path own_folder() {
  for (const fs::path& temporary : temporary_folders()) {
    const fs::path folder = temporary / fmt::format("wavetracer-pocl-{}", getuid());
    mkdir(folder.c_str(), 0700);
    struct stat status = {};
    const bool own = lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == getuid() &&
                     (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
    if (own && obstacle(folder).empty()) return folder;
  }
  return {};
}

// Tells whether a file that the OpenCL loader reads names PoCL.
bool is_installed() {
  std::error_code error;
  const std::string chosen = environment("OCL_ICD_VENDORS");
  const fs::path folder = chosen.empty() ? "/etc/OpenCL/vendors" : chosen;
  if (!fs::is_directory(folder, error)) return chosen.find("pocl") != std::string::npos;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::string line;
    std::ifstream in(entry.path());
    std::getline(in, line);
    if (line.find("pocl") != std::string::npos) return true;
  }
  return false;
}

// The note about the folder that give_pocl_a_cache() has chosen.
std::string& chosen_note() {
  static std::string note;
  return note;
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
  const bool chosen = !environment("POCL_CACHE_DIR").empty();
  if (!chosen) unsetenv("POCL_CACHE_DIR");  // PoCL would take an empty value for a folder
  const std::string why = obstacle(pocl_cache_folder());
  if (why.empty() || !is_installed()) return;
  if (chosen) {  // the user or an earlier call has set it
    if (chosen_note().empty())
      chosen_note() = fmt::format(
          "PoCL, the OpenCL of CPUs, may fail because of its cache ({}): set POCL_CACHE_DIR to another folder", why);
    return;
  }
  const fs::path folder = own_folder();
  if (folder.empty()) return;
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  chosen_note() = fmt::format(
      "PoCL, the OpenCL of CPUs, cannot write its cache ({}) and keeps it in {} instead: "
      "set POCL_CACHE_DIR to choose a folder",
      why, folder.string());
}

std::string pocl_cache_note() { return chosen_note(); }

std::string pocl_cache_problem() {
  const std::string why = write_obstacle(pocl_cache_folder());
  if (why.empty() || !is_installed()) return {};
  return fmt::format(
      "PoCL, the OpenCL of CPUs, is installed, but it cannot write its cache ({}) and then offers no device: "
      "set POCL_CACHE_DIR to a folder that can be written to",
      why);
}

}  // namespace wavetracer::gpu
