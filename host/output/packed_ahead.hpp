// SPDX-License-Identifier: Apache-2.0
// Compresses chunks of tables that still grow, before their file can be begun: the place of a chunk in a file depends
// on everything before it. They are kept in a hidden scratch file. Nothing depends on this work: a chunk that is
// missing, because there was no time or no space, is compressed when the file is written.
#pragma once
#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include "base/idle_threads.hpp"
#include "base/scratch_file.hpp"
#include "output/packed_chunk.hpp"
#include "output/table_layout.hpp"

namespace wavetracer {

class PackedAhead {
 public:
  // scratch: path beside which the chunks are stored. level: of the compression; with 0 nothing is done.
  // least_free_bytes: space that stays free on the disk. The threads must have stopped before this object is destroyed.
  PackedAhead(IdleThreads& threads, const std::filesystem::path& scratch, uint32_t level,
              uint64_t least_free_bytes = uint64_t{1} << 30);

  // Tells which tables have grown since the last call, by parts after the earlier ones, and starts the compression of
  // chunks that are full now. It must be called by one thread.
  void grow(const std::vector<GrowingGroup>& groups, std::span<const std::filesystem::path> parts);

  // Returns the number of chunks made so far.
  size_t count() const;

  // The following functions may be called from any thread once the worker threads have stopped.
  // take() returns and removes the chunk of the table that begins with this row, if there is one. Throws RuntimeError.
  std::optional<Bytes> take(const std::string& table, uint64_t first_row) const;
  // Tells whether these are the bytes of that chunk, by their hash, and they were proved to unpack to the rows.
  bool proves(const std::string& table, uint64_t first_row, const Bytes& packed) const;

 private:
  using ChunkName = std::pair<std::string, uint64_t>;  // table, first row
  struct Made {
    uint64_t at = 0, bytes = 0, hash = 0;
  };
  struct Task;
  struct Grown {
    uint64_t chunks = 0;  // number of chunks that were begun
    size_t piece = 0;     // the first piece with rows of the next chunk
  };
  IdleThreads& threads_;
  std::filesystem::path scratch_path_;
  uint32_t level_;
  uint64_t least_free_bytes_;
  ScratchFile scratch_;
  std::map<std::string, Grown> grown_;  // by name of the table
  std::atomic<bool> given_up_ = false;
  mutable std::mutex mutex_;  // protects the following members while threads run
  uint64_t end_ = 0;          // end of the scratch file
  std::map<ChunkName, Made> made_;

  void make(const Task& task);
};

}  // namespace wavetracer
