// SPDX-License-Identifier: Apache-2.0
// A peer of the sort benchmark on the OpenCL device itself: Boost.Compute's sort and sort_by_key.
// Compiled only where CMake found Boost.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "sort_peers.hpp"

namespace wavetracer::bench {

// Its run throws RuntimeError with OpenCL's answer if the device cannot run it.
template <class Key>
SortPeer boost_peer(const gpu::DeviceInfo& device, const std::vector<Key>& keys, bool payload);

}  // namespace wavetracer::bench
