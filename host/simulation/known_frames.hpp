// The frames that every device computes alike, bit for bit: how many paths each has, and hashes of them.
// One row a set of features, by CheckedFeatures::frame(). The test `device_check` prints what a row should be.
#pragma once
#include <array>
#include <cstdint>

namespace wavetracer {

struct KnownFrame {
  uint32_t paths = 0;
  uint64_t sequences = 0;  // mix64 of what the paths meet, and how
  uint64_t points = 0;     // mix64 of where
  bool operator==(const KnownFrame&) const = default;
};

// clang-format off
inline constexpr std::array<KnownFrame, 24> known_frames{{
}};
// clang-format on

}  // namespace wavetracer
