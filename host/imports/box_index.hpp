// SPDX-License-Identifier: Apache-2.0
// Finds the boxes that contain another one. Boxes are sorted by their left sides, and only those within the width of
// the widest box are looked at. It is fast if most boxes are small beside the map, and takes linear time otherwise.
#pragma once
#include <algorithm>
#include <vector>

#include "imports/rings.hpp"

namespace wavetracer::imports {

class BoxIndex {
 public:
  void add(const Box& box, size_t what) {
    entries_.push_back({box, what});
    widest_ = std::max(widest_, box.upper.x - box.lower.x);
  }
  void sort() {
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.box.lower.x < b.box.lower.x; });
  }
  // Calls visit(what) for every box that contains `box`, including `box` itself; sort() must be called before. Returns
  // false, after the first of them, if there are more than maps of buildings have: in a tower of n boxes each box lies
  // in n others.
  template <class Visit>
  bool containing(const Box& box, const Visit& visit) const {
    constexpr size_t most = 200;
    size_t found = 0;
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), box.lower.x - widest_,
                                  [](const Entry& e, int64_t x) { return e.box.lower.x < x; });
    for (; entry != entries_.end() && entry->box.lower.x <= box.lower.x; ++entry) {
      if (!entry->box.contains(box)) continue;
      if (++found > most) return false;
      visit(entry->what);
    }
    return true;
  }

 private:
  struct Entry {
    Box box;
    size_t what;
  };
  std::vector<Entry> entries_;
  int64_t widest_ = 0;
};

}  // namespace wavetracer::imports
