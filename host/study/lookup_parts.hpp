// SPDX-License-Identifier: Apache-2.0
// The parts of a look-up that the thesis timed apart: making the hash of a key, and the call of the buffer, which gives
// the address of an entry. No clock inside a kernel can time them, because the compiler mixes their instructions with
// others. They follow from look-ups of empty tables with each hash: the mixed hash computes both others.
#pragma once
#include <string>
#include <vector>
#include "study/cache_claims.hpp"

namespace wavetracer::study {

// Nanoseconds of a look-up. They come from differences, so that noise can make them negative.
struct LookupParts {
  Measured hash;
  // The rest of a look-up in an empty table: reading the ray, the address of the entry, and the first access to it. So
  // the thesis' call of the buffer takes no longer than this.
  Measured buffer_call;
};

// Takes rows of depth 1 (CacheStudy::first_depth) of a setting, whose name ends with that of a hash, and of the chained
// table with each hash. Parts that were not measured are NaN.
LookupParts lookup_parts(const CacheRows& rows, const std::string& setting);

// Answers for each of these settings whether the call of the buffer takes less than a tenth of a write. It does not if
// it takes more even without the time in which a whole ray is copied (gather_ns). Between these limits it is undecided.
Judge<CacheRow> buffer_calls_are_short(std::vector<std::string> settings);

}  // namespace wavetracer::study
