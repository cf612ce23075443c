// SPDX-License-Identifier: Apache-2.0
// Fuzz target: radar.h5 as plots read it. The HDF5 library may crash in a separate process: see LimitedChild.
#include "fuzz/children.hpp"
#include "fuzz/fuzz.hpp"
#include "results/saved_radar.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  [[maybe_unused]] static const int tame = fuzz::tame_children();
  return fuzz::accept_or_refuse([&] {
    const SavedRadar radar(file.write(data, size));
    for (size_t row = 0; row < radar.frames().size() && row < 4; ++row) radar.range_doppler(row);
    radar.spectrogram();
  });
}
