// SPDX-License-Identifier: Apache-2.0
// Each chirp of a pair of antennas has a stream of random numbers of its own, so the noise does not depend on the
// cores.
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "base/split_mix.hpp"
#include "radar/beat_signal.hpp"

namespace wavetracer {
namespace {

constexpr double boltzmann_j_k = 1.380649e-23, room_k = 290;

uint64_t folded(uint64_t seed, uint64_t value) { return SplitMix(seed ^ SplitMix(value).next()).next(); }

}  // namespace

void add_noise(BeatSignal& signal, const RadarConfig& radar, uint32_t frame, double time_s, Link link) {
  if (!radar.noise_figure_db) return;
  const double power_w =
      boltzmann_j_k * room_k * std::pow(10, *radar.noise_figure_db / 10) * radar.samples / radar.chirp_s;
  uint64_t seed = radar.seed.value_or(0);
  for (const char letter : radar.name) seed = folded(seed, static_cast<unsigned char>(letter));
  for (const uint64_t value : {uint64_t{frame}, std::bit_cast<uint64_t>(time_s), uint64_t{link.tx}, uint64_t{link.rx}})
    seed = folded(seed, value);
  tbb::parallel_for(size_t{0}, signal.rx_antennas * signal.tx_antennas * signal.chirps, [&](size_t row) {
    SplitMix random(folded(seed, row));
    for (size_t i = row * signal.samples; i < (row + 1) * signal.samples; ++i) {
      // A complex number of this mean power (Box and Muller, 1958).
      const double size = std::sqrt(-power_w * std::log(random.uniform()));
      const double angle = 2 * std::numbers::pi * random.uniform();
      signal.re[i] += size * std::cos(angle);
      signal.im[i] += size * std::sin(angle);
    }
  });
}

}  // namespace wavetracer
