// SPDX-License-Identifier: Apache-2.0
// Fuzz target: run.json, the facts about a run for `wavetracer merge`.
#include "fuzz/fuzz.hpp"
#include "jobs/run_record.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace wavetracer;
  return fuzz::accept_or_refuse([&] { decode_run_record(fuzz::text_of(data, size), "run.json"); });
}
