// Compressed chunks of tables that still grow, made before the file can be begun that they belong to: where a chunk
// lies in a file depends on all that comes before it. They wait in a file that nobody else sees. Nobody depends on it:
// what is not here, because there was no time or no room, is compressed when the file is written.
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
  // scratch: path beside which the chunks wait. level: of the compression; of 0 nothing is done. least_free_bytes: what
  // stays free on the disk. The threads must have stopped before this goes.
  PackedAhead(IdleThreads& threads, const std::filesystem::path& scratch, uint32_t level,
              uint64_t least_free_bytes = uint64_t{1} << 30);

  // Tables that have grown since the last call, by parts behind the ones that they had: has the chunks made that are
  // full now. Of one thread.
  void grow(const std::vector<GrowingGroup>& groups, std::span<const std::filesystem::path> parts);

  // Chunks that are made so far.
  size_t count() const;

  // What follows is asked once the threads have stopped, from any thread.
  // The chunk of the table that begins with this row, if it is here; it is not kept any longer. Throws RuntimeError.
  std::optional<Bytes> take(const std::string& table, uint64_t first_row) const;
  // Whether these are the bytes of that chunk, by their hash, and it was proved that the rows come out of them again.
  bool proves(const std::string& table, uint64_t first_row, const Bytes& packed) const;

 private:
  using ChunkName = std::pair<std::string, uint64_t>;  // table, first row
  struct Made {
    uint64_t at = 0, bytes = 0, hash = 0;
  };
  struct Task;
  struct Grown {
    uint64_t chunks = 0;  // that were begun
    size_t piece = 0;     // the first one with rows of the next chunk
  };
  IdleThreads& threads_;
  std::filesystem::path scratch_path_;
  uint32_t level_;
  uint64_t least_free_bytes_;
  ScratchFile scratch_;
  std::map<std::string, Grown> grown_;  // by table
  std::atomic<bool> given_up_ = false;
  mutable std::mutex mutex_;  // of what follows, while threads run
  uint64_t end_ = 0;          // of the scratch file
  std::map<ChunkName, Made> made_;

  void make(const Task& task);
};

}  // namespace wavetracer
