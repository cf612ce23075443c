// SPDX-License-Identifier: Apache-2.0
// Keeps compiled programs on disk, so that a second start does not compile.
// A file that differs in anything from the key is ignored; no function throws because of the disk.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wavetracer::gpu {

// Everything that a compiled program depends on.
struct ProgramKey {
  std::string source;  // with its includes expanded
  std::string options, platform, platform_version, device, driver;

  // Returns all fields except the source, each with its length, so that different keys have different texts.
  std::string text() const;
};

class ProgramCache {
 public:
  // Uses ${XDG_CACHE_HOME:-$HOME/.cache}/wavetracer/programs; the cache is off if WAVETRACER_NO_CACHE=1 or neither
  // variable is set.
  static ProgramCache from_environment();

  // An empty directory turns the cache off.
  explicit ProgramCache(std::filesystem::path directory) : directory_(std::move(directory)) {}

  // Returns the compiled program stored under this key, if there is one and it passes every check.
  std::optional<std::string> load(const ProgramKey& key) const;
  // Writes under a temporary name and renames, so that readers only see whole files. If that fails, the next start
  // compiles again: returns a message for the user then, else an empty text.
  std::string store(const ProgramKey& key, std::string_view compiled) const;

  // Is there a folder for programs that holds none yet, as before the first start?
  bool waits_for_first() const;

  // Returns the file of this key's program.
  std::filesystem::path path(const ProgramKey& key) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace wavetracer::gpu
