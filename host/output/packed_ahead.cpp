// SPDX-License-Identifier: Apache-2.0
// Each chunk is one task, which knows the pieces that its rows come from.
// A failure ends this work for good without a message: writing the file meets the same disk, and reports the error.
#include "output/packed_ahead.hpp"
#include <algorithm>
#include "base/hash.hpp"
#include "output/packed_rows.hpp"
#include "output/row_source.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

uint64_t hash_of(const Bytes& bytes) { return mix64({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); }

}  // namespace

struct PackedAhead::Task {
  ChunkName name;
  uint64_t begin, bytes;  // range in the table
  size_t value_bytes;
  std::vector<fs::path> parts;
  Pieces pieces;  // pieces of each part, with their places in the table
};

PackedAhead::PackedAhead(IdleThreads& threads, const fs::path& scratch, uint32_t level, uint64_t least_free_bytes)
    : threads_(threads),
      scratch_path_(scratch),
      level_(level),
      least_free_bytes_(least_free_bytes),
      scratch_(scratch) {}

void PackedAhead::grow(const std::vector<GrowingGroup>& groups, std::span<const fs::path> parts) {
  for (const GrowingGroup& group : groups)
    for (const GrowingTable& table : group.tables) {
      const uint64_t row_bytes = table.row_bytes(), rows = full_chunk_rows(row_bytes), bytes = rows * row_bytes;
      if (level_ == 0 || rows == 0) continue;
      Grown& grown = grown_[table.path];
      for (; (grown.chunks + 1) * rows <= table.rows; ++grown.chunks) {
        const auto task = std::make_shared<Task>(
            Task{{table.path, grown.chunks * rows}, grown.chunks * bytes, bytes, H5Tget_size(table.type), {}, {}});
        const uint64_t end = task->begin + bytes;
        for (;; ++grown.piece) {
          const auto& [part, piece] = table.pieces.at(grown.piece);
          if (piece.bytes > 0) {
            task->parts.push_back(parts[part]);
            task->pieces.push_back({piece});
          }
          if (piece.to + piece.bytes > end) break;  // the piece also begins the next chunk
          if (piece.to + piece.bytes == end) {
            ++grown.piece;
            break;
          }
        }
        threads_.enqueue([this, task] { make(*task); });
      }
    }
}

void PackedAhead::make(const Task& task) {
  if (given_up_) return;
  try {
    Bytes plain(task.bytes);
    RowSource(task.parts, task.pieces).read(task.begin, plain);
    plain = shuffled(plain, task.value_bytes);
    const Bytes packed = deflated(plain, level_);
    if (!inflates_to(packed, plain)) throw RuntimeError("a chunk is damaged");
    if (fs::space(scratch_path_.parent_path()).available < least_free_bytes_ + packed.size())
      throw RuntimeError("the disk is nearly full");
    Made made{0, packed.size(), hash_of(packed)};
    {
      const std::lock_guard lock(mutex_);
      made.at = std::exchange(end_, end_ + packed.size());
    }
    scratch_.write_at(made.at, packed);
    const std::lock_guard lock(mutex_);
    made_.emplace(task.name, made);
  } catch (const std::exception&) {
    given_up_ = true;
  }
}

size_t PackedAhead::count() const {
  const std::lock_guard lock(mutex_);
  return made_.size();
}

std::optional<Bytes> PackedAhead::take(const std::string& table, uint64_t first_row) const {
  const auto found = made_.find({table, first_row});
  if (found == made_.end()) return std::nullopt;
  Bytes packed(found->second.bytes);
  scratch_.read_at(found->second.at, packed);
  scratch_.forget(found->second.at, packed.size());
  return packed;
}

bool PackedAhead::proves(const std::string& table, uint64_t first_row, const Bytes& packed) const {
  const auto found = made_.find({table, first_row});
  return found != made_.end() && packed.size() == found->second.bytes && hash_of(packed) == found->second.hash;
}

}  // namespace wavetracer
