// SPDX-License-Identifier: Apache-2.0
// Frames of a run are sorted by their numbers.
#include "app/saved_frames.hpp"
#include <fmt/format.h>
#include "jobs/frame_range.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {

FrameRows frame_rows(const SavedRun& run, const std::string& text) {
  const size_t count = run.frame_count();
  FrameRows rows{0, count - 1};
  if (text.empty()) return rows;
  const uint32_t first = run.number(0), last = run.number(count - 1);
  const FrameRange range = parse_frames(text, uint64_t{last} + 1);
  while (rows.first < count && run.number(rows.first) < range.first) ++rows.first;
  while (rows.last > 0 && run.number(rows.last) > range.last) --rows.last;
  if (rows.first == count || run.number(rows.last) > range.last || rows.first > rows.last)
    throw ConfigError(fmt::format("--frames {}: {} has frames {} to {}", text, run.file().string(), first, last));
  return rows;
}

}  // namespace wavetracer::app
