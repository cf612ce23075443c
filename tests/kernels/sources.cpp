// SPDX-License-Identifier: Apache-2.0
// Registers the kernels of this folder with those that are built into the library, before main begins.
#include "gpu/source.hpp"

namespace wavetracer::gpu {

std::span<const EmbeddedFile> test_files();  // generated from this folder by cmake/embed_kernels.cmake

namespace {
[[maybe_unused]] const bool registered = (add_files(test_files()), true);
}

}  // namespace wavetracer::gpu
