// SPDX-License-Identifier: Apache-2.0
// The last words of a command: the files that it has written.
#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace wavetracer::app {

// Returns the line that names these files, with its end.
inline std::string written_line(std::span<const std::filesystem::path> files) {
  std::string out = "written    ";
  for (size_t i = 0; i < files.size(); ++i) out += (i == 0 ? "" : ", ") + files[i].string();
  return out + "\n";
}

}  // namespace wavetracer::app
