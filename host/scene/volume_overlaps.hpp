// SPDX-License-Identifier: Apache-2.0
// Volumes that share space. Space within several volumes belongs to the first of them (wavetracer/device/volumes.h).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns for each volume the numbers of earlier volumes whose axis-parallel boxes overlap its own, in ascending order.
// Boxes that only touch do not overlap.
std::vector<std::vector<uint32_t>> earlier_volumes(const std::vector<Volume>& volumes);

// Drops volumes that repeat an earlier one. Adds warnings that count those, and warnings about volumes that may lose
// space to one of another material.
void settle_overlaps(std::vector<Volume>& volumes, std::vector<std::string>& warnings);

}  // namespace wavetracer
