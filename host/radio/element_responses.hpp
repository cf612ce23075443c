// SPDX-License-Identifier: Apache-2.0
// The responses of all links of a frame, as [response] asks for them.
#pragma once
#include "wavetracer/arrays.hpp"

namespace wavetracer {

// Returns nothing where response.bandwidth_hz is not given. frame: with the coefficients of all carriers. Throws
// RuntimeError where the responses are too many for the memory of a frame.
Responses make_responses(const ElementModel& model, const Config& config, const FrameResult& frame);

}  // namespace wavetracer
