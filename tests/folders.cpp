// SPDX-License-Identifier: Apache-2.0
// The paths come from CMake.
#include "folders.hpp"

namespace wavetracer::test {

std::string source_folder() { return WAVETRACER_SOURCE; }
std::string shared_folder() { return WAVETRACER_SHARED; }
std::string build_folder() { return WAVETRACER_BINARY_DIR; }
std::string program() { return WAVETRACER_PROGRAM; }

}  // namespace wavetracer::test
