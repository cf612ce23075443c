// SPDX-License-Identifier: Apache-2.0
// Finds the strongest of very many rows in two passes with bounded memory: first all gains are counted, then rows are
// kept. Gains are distinguished to 1/100 dB from -400 to 200 dB; of equal ones the first are kept.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace wavetracer {

class Strongest {
 public:
  void count(double gain_db, uint64_t bytes) {
    Bin& bin = bins_[index(gain_db)];
    ++bin.rows;
    bin.bytes += bytes;
    ++rows_;
  }
  uint64_t rows() const { return rows_; }

  // Must be called after the last count(): keeps at most max_rows rows with at most max_bytes bytes.
  void limit(uint64_t max_rows, uint64_t max_bytes) {
    for (last_ = bins_.size() - 1; last_ > 0; --last_) {
      const Bin& bin = bins_[last_];
      if (bin.rows > max_rows || bin.bytes > max_bytes) break;
      max_rows -= bin.rows;
      max_bytes -= bin.bytes;
    }
    left_rows_ = max_rows;
    left_bytes_ = max_bytes;
  }

  // Must be called with each row again, in the same order; returns whether it is kept.
  bool keep(double gain_db, uint64_t bytes) {
    const size_t bin = index(gain_db);
    if (bin != last_) return bin > last_;
    if (left_rows_ == 0 || bytes > left_bytes_) return false;
    --left_rows_;
    left_bytes_ -= bytes;
    return true;
  }

 private:
  struct Bin {
    uint64_t rows = 0, bytes = 0;
  };
  static constexpr double lowest_db = -400, highest_db = 200, bins_a_db = 100;
  static size_t index(double gain_db) {
    if (!(gain_db > lowest_db)) return 0;  // for zero power, or not a number
    return static_cast<size_t>((std::min(gain_db, highest_db) - lowest_db) * bins_a_db);
  }
  std::vector<Bin> bins_ = std::vector<Bin>(static_cast<size_t>((highest_db - lowest_db) * bins_a_db) + 1);
  uint64_t rows_ = 0, left_rows_ = 0, left_bytes_ = 0;
  size_t last_ = 0;  // rows of higher bins are all kept, and as many rows of this bin as there is room for
};

}  // namespace wavetracer
