// One thread, for one unit at a time: HDF5 has no more.
// Assumes that what a Run refers to does not change while frames are computed.
#include "app/unit_writer.hpp"
#include <fmt/format.h>

namespace wavetracer::app {

void UnitWriter::write(const Unit& unit, std::vector<FrameResult> frames) {
  finish();
  writing_ = std::async(std::launch::async, [this, unit, frames = std::move(frames)] {
    return shards_.write_files(run_, frames, unit.block, unit.blocks);
  });
}

void UnitWriter::finish() {
  if (!writing_.valid()) return;
  const Shard shard = writing_.get();
  shards_.finish(shard);
  progress_.line(fmt::format("{}: {} paths", unit_words(shard.unit), shard.totals.counts.paths));
}

void UnitWriter::finish_quietly() noexcept {
  try {
    finish();
  } catch (...) {
  }
}

}  // namespace wavetracer::app
