// SPDX-License-Identifier: Apache-2.0
// Kernel sources: the table embedded in the library, and the original places of lines after the expansion of includes.
// Paths are those of the source tree: "kernels/paths/visible.cl", "include/wavetracer/device/bvh.h".
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace wavetracer::gpu {

struct EmbeddedFile {
  std::string_view path, text;
};

// Generated at build time by cmake/embed_kernels.cmake, sorted by path.
std::span<const EmbeddedFile> embedded_files();

// Adds files that programs may name like the embedded ones, even with WAVETRACER_KERNEL_DIR set: the kernels of tests.
// It is not thread-safe, and must be called before main.
void add_files(std::span<const EmbeddedFile> files);

// Returns a build log with the places that the #line directives of `source` give. NVIDIA and Oclgrind count the lines
// of the text that they were given ("<kernel>:812:5", "input.cl:812:5"); PoCL follows the directives, and its log is
// returned unchanged.
std::string with_places(const std::string& log, const std::string& source);

}  // namespace wavetracer::gpu
