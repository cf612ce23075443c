// SPDX-License-Identifier: Apache-2.0
// The content of a figure about a study of caches: its plot, its numbers, and its table if that does not have all
// columns.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_study.hpp"
#include "study/scripts.hpp"
#include "study/text.hpp"

namespace wavetracer::study {

struct CacheShown {
  LinePlot plot;                        // without name and title
  Csv table = {};                       // without columns: all columns
  NumberTable numbers = {};             // empty: summary_table
  std::vector<std::string> notes = {};  // in addition to study_notes
};
using CacheView = std::function<CacheShown(const CacheMeasurement&)>;

// Against the number of rays: times with a warm table and with an empty one; time and saved time; errors.
CacheShown times_by_rays(const CacheMeasurement& measured);
CacheShown savings_by_rays(const CacheMeasurement& measured);
CacheShown errors_by_rays(const CacheMeasurement& measured);
// Shows distances of centroids of these settings, frame by frame.
CacheView centroids(std::vector<std::string> settings);
// Shows speed and errors at the most rays against a column in which settings of one name differ. head, value: of the
// column, in the table of the fastest settings that lose little enough.
CacheView trade(const std::string& column, const std::string& label, const std::string& head,
                std::function<std::string(const CacheRow&)> value);

// Returns time saved and errors at the most rays, a row per drive and setting except the first, the fastest first.
NumberTable summary_table(const std::vector<CacheRow>& rows);
// Returns a panel for every drive in which its column has a value, with the drive in its title if there are several.
std::vector<LinePanel> panels_of(const std::vector<CacheRow>& rows, const std::vector<LinePanel>& a_drive);
// Says how it was measured. repeats: frames with an empty table, and with a warm one, of a world without motion.
std::vector<std::string> study_notes(const CacheMeasurement& measured, uint32_t repeats);

}  // namespace wavetracer::study
