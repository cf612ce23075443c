// Compiled programs kept on disk, so that a second start does not compile.
// A file that differs in anything from what is asked for is as good as absent; nothing here ever throws for the disk's
// sake.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace wavetracer::gpu {

// Everything that a compiled program depends on.
struct ProgramKey {
  std::string source;  // expanded
  std::string options, platform, platform_version, device, driver;

  // All but the source, each field with its length so that no two keys read the same.
  std::string text() const;
};

class ProgramCache {
 public:
  // ${XDG_CACHE_HOME:-$HOME/.cache}/wavetracer/programs; off where WAVETRACER_NO_CACHE=1 or neither variable is set.
  static ProgramCache from_environment();

  // An empty directory turns the cache off.
  explicit ProgramCache(std::filesystem::path directory) : directory_(std::move(directory)) {}

  // The compiled program stored under this key, if there is one and every check holds.
  std::optional<std::string> load(const ProgramKey& key) const;
  // Written under a temporary name and renamed, so that readers see whole files only. Failure costs the next start its
  // time: returns what to tell the user then, else an empty text.
  std::string store(const ProgramKey& key, std::string_view compiled) const;

  // Where this key's program is kept.
  std::filesystem::path path(const ProgramKey& key) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace wavetracer::gpu
