// SPDX-License-Identifier: Apache-2.0
// Tells which run the parts in a folder belong to.
#pragma once
#include "jobs/frame_range.hpp"
#include "jobs/manifest.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Two runs with the same identity write the same frames: version, kind of device, configuration, contents of all input
// files, frames and repeats. The places of outputs and inputs, and whether shards are kept, do not count.
RunIdentity identity_of(const Config& config, const RunSummary& summary, const FrameRange& range);

}  // namespace wavetracer
