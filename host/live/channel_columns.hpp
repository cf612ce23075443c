// SPDX-License-Identifier: Apache-2.0
// Writes the channels of a frame as columns in CBOR (RFC 8949): one map, whose columns are typed arrays (RFC 8746),
// which numpy and others read without a copy. docs/live.md lists the keys.
#pragma once
#include <string>
#include <vector>

#include "live/message.hpp"
#include "live/radar_answer.hpp"
#include "radio/links.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer::live {

// figures: figures of the frame's links, in their order.
std::string channel_columns(const LiveFrame& frame, const std::vector<LinkFigures>& figures, Detail detail,
                            const RadarAnswer& radars);

}  // namespace wavetracer::live
