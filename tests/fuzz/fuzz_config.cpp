// SPDX-License-Identifier: Apache-2.0
// Fuzz target: configurations, from TOML text to checked values and back to text.
// An accepted configuration must be accepted again after it was written out.
#include "fuzz/fuzz.hpp"
#include "wavetracer/config_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  Config config;
  bool accepted = false;
  fuzz::accept_or_refuse([&] {
    config = parse_config(fuzz::text_of(data, size), "fuzz.toml");
    accepted = true;
  });
  if (accepted) parse_config(config.text, "again.toml");
  return 0;
}
