// SPDX-License-Identifier: Apache-2.0
// The claims of figures 6.2 to 6.9, and the names of the tables that they are about.
// A. Zhdanov, TU Munich, 2014, section 6.3.1.
#pragma once
#include <string>
#include <vector>
#include "study/cache_claims.hpp"
#include "study/entry_views.hpp"

namespace wavetracer::study {

using Names = std::vector<std::string>;

// Returns our tables, then the same as the thesis prints them.
inline Names with_printed(Names names) {
  const Names ours = names;
  for (const std::string& name : ours) names.push_back("printed " + name);
  return names;
}

inline const Names chained_tables = {"chained uniform", "chained Morton", "chained mixed"},
                   mutexes = {"mutex uniform", "mutex Morton", "mutex mixed"},
                   readers = {"readers uniform", "readers Morton", "readers mixed"},
                   all_chained = with_printed(chained_tables), all_mutexes = with_printed(mutexes);

Claims<CacheRow> write_claims();    // figure 6.2
Claims<CacheRow> bucket_claims();   // figure 6.3
Claims<CacheRow> hit_claims();      // figure 6.4
Claims<CacheRow> window_claims();   // figure 6.5
Claims<CacheRow> lock_claims();     // figure 6.6
Claims<CacheRow> region_claims();   // figure 6.7
Claims<CacheRow> open_claims();     // figure 6.8
Claims<CacheRow> ordered_claims();  // figure 6.9

}  // namespace wavetracer::study
