// SPDX-License-Identifier: Apache-2.0
// Fuzz target: messages of live clients, which may be refused by a ProtocolError and by nothing else.
#include "fuzz/fuzz.hpp"
#include "live/message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    wavetracer::live::parse_message(wavetracer::fuzz::text_of(data, size), 8);
  } catch (const wavetracer::live::ProtocolError&) {
  }
  return 0;
}
