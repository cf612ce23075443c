// SPDX-License-Identifier: Apache-2.0
// Fuzz target: responses.h5 as exports read it. The HDF5 library may crash in a separate process: see LimitedChild.
#include "fuzz/children.hpp"
#include "fuzz/fuzz.hpp"
#include "results/saved_responses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  static fuzz::MemoryFile file;
  [[maybe_unused]] static const int tame = fuzz::tame_children();
  return fuzz::accept_or_refuse([&] {
    const SavedResponses responses(file.write(data, size));
    for (uint32_t number = 0; number < 4; ++number) responses.frame(number);
  });
}
