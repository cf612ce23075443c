// SPDX-License-Identifier: Apache-2.0
// Figures 6.2, 6.3, 6.6 and 6.7 of the thesis: times of a table's operations, entry by entry along the buffer.
// A study must have each setting, its counted twin, and rows of depth 1.
#pragma once
#include <string>
#include <vector>
#include "study/cache_views.hpp"

namespace wavetracer::study {

struct BufferFigure {
  std::vector<std::string> settings;
  bool traces = false;     // tracing is shown, too (figures 6.3 and 6.7)
  bool by_region = false;  // rows of regions give their times, and the table has a row for each (figures 6.6 and 6.7)
};

// Shows a panel per setting, with time against the place in the table: points of writes and reads for some hundred
// entries at equal distances, lines of the hash, of the call of the buffer (and of tracing). The clock of a compute
// unit is no timer, so it only spreads times over entries: the mean of the entries of a region is what profiling
// events say a segment takes there.
CacheView along_buffer(const BufferFigure& figure);

}  // namespace wavetracer::study
