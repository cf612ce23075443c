// SPDX-License-Identifier: Apache-2.0
// Checks of a small frame: its set of sequences, its paths and their fields, and the answers of a ray cache.
#pragma once
#include <vector>

#include "simulation/check_result.hpp"
#include "simulation/checked_features.hpp"
#include "simulation/frame.hpp"
#include "simulation/known_frames.hpp"

namespace wavetracer {

// The paths of a frame in the form of known_frames.hpp.
KnownFrame known_of(const Paths& paths);

// Checks that the set of sequences that the setup's last frame left on the device holds each once, below another one.
CheckResult check_sequences(Setup& setup, const FrameResult& frame);
// Checks that the paths are those of the known frame of these features.
CheckResult check_paths(const FrameResult& frame, const CheckedFeatures& features);
// Checks that the fields of the setup's last frame are the host's own, to the last bit.
CheckResult check_fields(Setup& setup, const FrameResult& frame);
// again: the same frame after `first`; its cache must answer some rays, and must not change the paths.
CheckResult check_cached(const FrameResult& first, const FrameResult& again);
// again: the same frame after `first`, which reuses what that one has found; it must have the same paths.
CheckResult check_reused(const FrameResult& first, const FrameResult& again);
// summed: the same frame with sums of links that the device made; they must be those of the paths.
CheckResult check_sums_of_links(const FrameResult& frame, const FrameResult& summed, double frequency_hz);

}  // namespace wavetracer
