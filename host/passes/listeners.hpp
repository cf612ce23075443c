// SPDX-License-Identifier: Apache-2.0
// Listeners: receivers from which sequences begin, where paths are met from both ends. Receivers that stand close
// together are one listener where they hear the rays of edges: what one of them hears, all of them try.
#pragma once
#include <cstdint>
#include <vector>

namespace wavetracer {

// The receivers of listener i are receivers[first[i]] to receivers[first[i + 1] - 1], and none is in two of them.
struct Listeners {
  std::vector<uint32_t> first{0}, receivers;

  uint32_t count() const { return static_cast<uint32_t>(first.size() - 1); }
  // Ends the listener of the receivers that were added since the one before.
  void close() { first.push_back(static_cast<uint32_t>(receivers.size())); }
};

// Each of these receivers is a listener of its own.
inline Listeners single_listeners(const std::vector<uint32_t>& receivers) {
  Listeners out;
  for (const uint32_t receiver : receivers) {
    out.receivers.push_back(receiver);
    out.close();
  }
  return out;
}

}  // namespace wavetracer
