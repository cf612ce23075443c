// Volumes that share space. Space that several volumes hold is that of the first (wavetracer/device/volumes.h).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// For each volume: the numbers of those before it whose boxes, along the axes, meet its own, in ascending order. Boxes
// that touch do not meet.
std::vector<std::vector<uint32_t>> earlier_volumes(const std::vector<Volume>& volumes);

// Drops volumes that are the same as one before them. Adds warnings that count those, and volumes that may lose space
// to one of another material.
void settle_overlaps(std::vector<Volume>& volumes, std::vector<std::string>& warnings);

}  // namespace wavetracer
