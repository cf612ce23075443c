// Rows that lie in pieces in many files, read by the place that they go to.
#pragma once
#include <filesystem>
#include <span>
#include <vector>
#include "output/copy_pieces.hpp"

namespace wavetracer {

class RowSource {
 public:
  // parts: must outlive it.
  RowSource(std::span<const std::filesystem::path> parts, const Pieces& pieces);
  // The bytes that go to this place and on, from any thread. Throws RuntimeError that names the part that is too short.
  void read(uint64_t place, std::span<std::byte> bytes) const;
  // A piece begins there.
  bool begins_at(uint64_t place) const;
  // Of all pieces.
  uint64_t bytes() const { return bytes_; }

 private:
  struct Placed {
    Piece piece;
    size_t part;
    uint64_t end() const { return piece.to + piece.bytes; }
  };
  std::span<const std::filesystem::path> parts_;
  std::vector<Placed> placed_;  // by place
  uint64_t bytes_ = 0;
};

}  // namespace wavetracer
