// SPDX-License-Identifier: Apache-2.0
// The text of `wavetracer --version`: the version on its first line, then how and from what the program was built.
// cmake/build_info.cmake writes it into a file of its own, so that a commit recompiles nothing else.
#pragma once

namespace wavetracer::app {

extern const char* const build_info;

}  // namespace wavetracer::app
