// SPDX-License-Identifier: Apache-2.0
// Finds the boxes of a map that contain another one: those of a BoxGrid at its lower corner, compared as integers.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "imports/rings.hpp"
#include "scene/box_grid.hpp"

namespace wavetracer::imports {

class BoxIndex {
 public:
  struct Entry {
    Box box;
    size_t what;
  };
  explicit BoxIndex(std::vector<Entry> entries)
      : entries_(by_left_side(std::move(entries))), grid_(boxes_of(entries_)) {}

  // Calls visit(what) for every box that contains `box`, including `box` itself, from left to right. Returns false if
  // there are more than maps of buildings have, after the first of them: in a tower of n boxes each box lies in n
  // others.
  template <class Visit>
  bool containing(const Box& box, const Visit& visit) const {
    constexpr size_t most = 200;
    size_t found = 0;
    grid_.at(place(box.lower), 0, [&](uint32_t k) {
      const Entry& entry = entries_[k];
      if (entry.box.contains(box) && ++found <= most) visit(entry.what);
    });
    return found <= most;
  }

 private:
  static glm::dvec3 place(const Point& p) { return {static_cast<double>(p.x), static_cast<double>(p.y), 0}; }
  static std::vector<Entry> by_left_side(std::vector<Entry> entries) {
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.box.lower.x < b.box.lower.x; });
    return entries;
  }
  static std::vector<SceneBox> boxes_of(const std::vector<Entry>& entries) {
    std::vector<SceneBox> out;
    for (const Entry& entry : entries) out.push_back({place(entry.box.lower), place(entry.box.upper)});
    return out;
  }

  std::vector<Entry> entries_;
  BoxGrid grid_;
};

}  // namespace wavetracer::imports
