// SPDX-License-Identifier: Apache-2.0
// Reads rows that lie in pieces in many files, by their target place.
#pragma once
#include <filesystem>
#include <span>
#include <vector>
#include "output/copy_pieces.hpp"

namespace wavetracer {

class RowSource {
 public:
  // parts: must outlive this object.
  RowSource(std::span<const std::filesystem::path> parts, const Pieces& pieces);
  // Reads the bytes from this target place on; it may be called from any thread. Throws RuntimeError that names the
  // part that is too short.
  void read(uint64_t place, std::span<std::byte> bytes) const;
  // Tells whether a piece begins at this place.
  bool begins_at(uint64_t place) const;
  // Number of bytes of all pieces.
  uint64_t bytes() const { return bytes_; }

 private:
  struct Placed {
    Piece piece;
    size_t part;
    uint64_t end() const { return piece.to + piece.bytes; }
  };
  std::span<const std::filesystem::path> parts_;
  std::vector<Placed> placed_;  // sorted by place
  uint64_t bytes_ = 0;
};

}  // namespace wavetracer
