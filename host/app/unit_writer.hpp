// Writes the units of a run while the next one is computed.
#pragma once
#include <future>
#include <vector>
#include "app/progress.hpp"
#include "output/shards.hpp"

namespace wavetracer::app {

class UnitWriter {
 public:
  // All of them must outlive it.
  UnitWriter(const Run& run, Shards& shards, Progress& progress) : run_(run), shards_(shards), progress_(progress) {}
  // What is being written is written, though nobody hears of an error.
  ~UnitWriter() { finish_quietly(); }
  UnitWriter(const UnitWriter&) = delete;
  UnitWriter& operator=(const UnitWriter&) = delete;

  // Begins to write a unit, once the one before is written.
  void write(const Unit& unit, std::vector<FrameResult> frames);
  // Waits until the last one is written and counts as finished. Throws what its writing threw. Nothing else may touch
  // files of the shards before.
  void finish();

 private:
  const Run& run_;
  Shards& shards_;
  Progress& progress_;
  std::future<Shard> writing_;

  void finish_quietly() noexcept;
};

}  // namespace wavetracer::app
