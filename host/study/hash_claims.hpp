// SPDX-License-Identifier: Apache-2.0
// The claims of figures 6.14, 6.16 and 6.17 about tables with the three hash functions, which are made of our tables
// and of those as the thesis prints them.
#pragma once
#include <string>

#include "study/cache_claims.hpp"

namespace wavetracer::study {

// Returns the name of the setting whose table stands for that of this setting.
using SettingName = std::string(const std::string& setting);

Claims<CacheRow> hash_times(SettingName* of);      // figure 6.14
Claims<CacheRow> ordered_times(SettingName* of);   // figure 6.16
Claims<CacheRow> ordered_errors(SettingName* of);  // figure 6.17

// Returns the claims about our tables, `further` ones, and the same claims about printed tables: repetitions, whose
// words begin with "as printed: ".
Claims<CacheRow> with_printed(Claims<CacheRow> (*claims)(SettingName*), const Claims<CacheRow>& further = {});

}  // namespace wavetracer::study
