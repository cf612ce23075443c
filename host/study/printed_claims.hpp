// SPDX-License-Identifier: Apache-2.0
// The claims of figures 6.14, 6.16 and 6.17 about tables as the thesis prints them. Each repeats a claim about ours.
#pragma once
#include "study/cache_claims.hpp"

namespace wavetracer::study {

Claims<CacheRow> printed_hash_times();      // figure 6.14
Claims<CacheRow> printed_ordered_times();   // figure 6.16
Claims<CacheRow> printed_ordered_errors();  // figure 6.17

}  // namespace wavetracer::study
