// SPDX-License-Identifier: Apache-2.0
// The counters of coverage. This file is compiled without coverage, which would declare these two names itself and
// count each step of the loops.
#include <algorithm>
#include <bit>
#include <cstring>
#include "fuzz/worker.hpp"

extern "C" __attribute__((weak, visibility("hidden"))) uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

namespace wavetracer::fuzz {

std::span<uint8_t> counters() {
  if (!__start___sancov_cntrs) return {};
  return {__start___sancov_cntrs, __stop___sancov_cntrs};
}

bool note_coverage(uint8_t* last, uint8_t* seen) {
  const std::span<const uint8_t> now = counters();
  if (now.empty()) return false;
  std::memcpy(last, now.data(), now.size());
  uint8_t any = 0;
  for (size_t begin = 0; begin < now.size(); begin += 64) {
    const std::span<const uint8_t> some = now.subspan(begin, std::min<size_t>(64, now.size() - begin));
    if (std::ranges::count(some, 0) == std::ssize(some)) continue;
    for (size_t i = 0; i < some.size(); ++i) {
      const uint8_t kind = std::bit_floor(some[i]);
      any |= kind & ~seen[begin + i];
      seen[begin + i] |= kind;
    }
  }
  return any != 0;
}

}  // namespace wavetracer::fuzz
