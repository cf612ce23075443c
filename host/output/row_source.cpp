// SPDX-License-Identifier: Apache-2.0
// Uses binary search; a file stays open as long as successive pieces come from it.
// Pieces must not overlap.
#include "output/row_source.hpp"
#include <algorithm>
#include <fstream>
#include "wavetracer/error.hpp"

namespace wavetracer {

RowSource::RowSource(std::span<const std::filesystem::path> parts, const Pieces& pieces) : parts_(parts) {
  for (size_t part = 0; part < pieces.size(); ++part)
    for (const Piece& piece : pieces[part])
      if (piece.bytes > 0) {
        placed_.push_back({piece, part});
        bytes_ += piece.bytes;
      }
  std::ranges::sort(placed_, {}, [](const Placed& p) { return p.piece.to; });
}

void RowSource::read(uint64_t place, std::span<std::byte> bytes) const {
  auto at = std::ranges::upper_bound(placed_, place, {}, &Placed::end);
  std::ifstream in;
  size_t open = parts_.size();
  while (!bytes.empty()) {
    if (at == placed_.end() || at->piece.to > place)
      throw RuntimeError("rows of a table are in no part; this is a fault of wavetracer, report it");
    if (open != at->part) {
      in = std::ifstream(parts_[at->part], std::ios::binary);
      open = at->part;
    }
    const std::span<std::byte> some = bytes.first(std::min<uint64_t>(bytes.size(), at->end() - place));
    read_piece(in, parts_[at->part], at->piece, place - at->piece.to, some);
    bytes = bytes.subspan(some.size());
    place += some.size();
    ++at;
  }
}

bool RowSource::begins_at(uint64_t place) const {
  const auto at = std::ranges::lower_bound(placed_, place, {}, [](const Placed& p) { return p.piece.to; });
  return at != placed_.end() && at->piece.to == place;
}

}  // namespace wavetracer
