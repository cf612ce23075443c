// SPDX-License-Identifier: Apache-2.0
// Writes cache_entries.h5: one table, /cache_entries, a row per entry that holds a segment.
// A. Zhdanov, TU Munich, 2014, section 6.3.1, prints such a file: element, times of its operations, hits.
#include "output/cache_entries_h5.hpp"
#include <fmt/format.h>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

bool is_rectangular(const CacheEntryRows& rows) {
  const size_t count = rows.size();
  return rows.frame.size() == count && rows.region.size() == count && rows.depth.size() == count &&
         rows.hits.size() == count && rows.age.size() == count && rows.length_m.size() == count &&
         rows.read_cycles.size() == count && rows.write_cycles.size() == count;
}

}  // namespace

void encode_cache_entries_head_h5(const Run& run, hdf5::File& file) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer cache entries");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{1});
  text("version", run.summary.version);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
}

void append_cache_entries_h5(const Run&, const FrameResult& frame, FrameTables& tables) {
  const CacheEntryRows& rows = frame.cache_entries;
  if (!is_rectangular(rows))
    throw RuntimeError(
        fmt::format("the cache entries of frame {} have columns of unequal length; this is a fault of wavetracer, "
                    "report it",
                    frame.frame));
  tables.group("/cache_entries",
               "one row per entry of the ray cache that holds a segment, after each frame, sorted by frame and slot");
  const auto column = [&](const char* name, const char* unit, const char* description, const auto& values) {
    tables.append(name, {unit, description}, std::span(values));
  };
  column("frame", "1", "number of the frame, see /frames/frame of paths.h5", rows.frame);
  column("slot", "1", "place in the table", rows.slot);
  column("region", "1",
         "part of the table, which belongs to one end: the rows of /transmitters of paths.h5, then, with diffraction, "
         "the receivers that launch rays too",
         rows.region);
  column("depth", "1",
         "steps of a search until it meets the entry: 1 in the bucket itself, more in the bucket's tree; "
         "0 if no search meets it, because another ray wrote the same segment first",
         rows.depth);
  column("hits", "1", "look-ups that the entry has answered since its region was cleared", rows.hits);
  column("age", "frames",
         "frames since the entry was written, 0 in the frame that wrote it; 4294967295 if it was withdrawn "
         "because something moved",
         rows.age);
  column("length_m", "m", "length of the segment; infinite where the ray met nothing", rows.length_m);
  column("read_cycles", "cycles of the device's clock",
         "duration of the last look-up that the entry answered; 0 if there was none, or if the device has no clock",
         rows.read_cycles);
  column("write_cycles", "cycles of the device's clock", "duration of the last write of the entry", rows.write_cycles);
}

}  // namespace wavetracer
