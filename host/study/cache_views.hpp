// What a figure shows of a study of caches: its plot, its numbers, and its table where that is not of all columns.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_study.hpp"
#include "study/scripts.hpp"
#include "study/text.hpp"

namespace wavetracer::study {

struct CacheShown {
  LinePlot plot;                        // without name and title; columns only of a table of its own
  std::string table = "";               // empty: all columns
  NumberTable numbers = {};             // empty: summary_table
  std::vector<std::string> notes = {};  // beside study_notes
};
using CacheView = std::function<CacheShown(const CacheMeasurement&)>;

// Nanoseconds per segment to write, to read, to gather (and to trace) of these settings, depth by depth.
CacheView operations(std::vector<std::string> settings, bool with_trace = false);
// Against the number of rays: times with a warm table and with an empty one; time and what is saved of it; errors.
CacheShown times_by_rays(const CacheMeasurement& measured);
CacheShown savings_by_rays(const CacheMeasurement& measured);
CacheShown errors_by_rays(const CacheMeasurement& measured);
// Distances of centroids, frame by frame, of these settings.
CacheView centroids(std::vector<std::string> settings);
// Speed and errors at the most rays against a column, by which the settings of one name differ. head, value: of the
// column, in the table of the fastest settings that lose little enough.
CacheView trade(const std::string& column, const std::string& label, const std::string& head,
                std::function<std::string(const CacheRow&)> value);

// Time saved and errors at the most rays, a row a drive and setting but the first, the fastest first.
NumberTable summary_table(const std::vector<CacheRow>& rows);
// A panel for every drive in which its column has a value, with the drive in its title where there are several.
std::vector<LinePanel> panels_of(const std::vector<CacheRow>& rows, const std::vector<LinePanel>& a_drive);
// How it was measured. repeats: frames with an empty table, and with a warm one, of a standing world.
std::vector<std::string> study_notes(const CacheMeasurement& measured, uint32_t repeats);

}  // namespace wavetracer::study
