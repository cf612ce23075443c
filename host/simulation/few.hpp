// SPDX-License-Identifier: Apache-2.0
// The first few texts of a list, then the number of the others, for warnings.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

namespace wavetracer {

class Few {
 public:
  explicit Few(std::vector<std::string>& out) : out_(out) {}
  void add(const std::string& text) {
    if (count_++ < shown) out_.push_back(text);
  }
  // what: "more antennas are below the ground"; added with their number if there are more.
  void end(const std::string& what) {
    if (count_ > shown) out_.push_back(fmt::format("{} {}", count_ - shown, what));
  }

 private:
  static constexpr size_t shown = 5;
  std::vector<std::string>& out_;
  size_t count_ = 0;
};

}  // namespace wavetracer
