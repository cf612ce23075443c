// SPDX-License-Identifier: Apache-2.0
// Objects of OpenStreetMap by id, the last version of each: histories and change files contain several.
// The last version has the highest number; of equal numbers, it is the later one in the file.
#pragma once
#include <algorithm>
#include <cstdint>
#include <osmium/osm/location.hpp>
#include <vector>

namespace wavetracer::imports {

// A version of a way, of a relation or of a tree.
struct ObjectVersion {
  int64_t id;
  uint32_t version;
  bool kept, deleted;  // kept: it is in the buffer at `offset`; deleted: it would be built, but no longer exists
  size_t offset;
};

// Keeps the last version of each object, sorted by id.
inline void keep_last_versions(std::vector<ObjectVersion>& objects) {
  std::stable_sort(objects.begin(), objects.end(), [](const ObjectVersion& a, const ObjectVersion& b) {
    return a.id != b.id ? a.id < b.id : a.version < b.version;
  });
  size_t kept = 0;
  for (size_t i = 0; i < objects.size(); ++i)
    if (i + 1 == objects.size() || objects[i + 1].id != objects[i].id) objects[kept++] = objects[i];
  objects.resize(kept);
}

// The places of nodes. A version without a place says that the node was deleted.
class NodePlaces {
 public:
  void add(int64_t id, uint32_t version, osmium::Location place) { nodes_.push_back({id, place, version}); }
  // Must be called once before place().
  void sort() {
    const auto before = [](const Node& a, const Node& b) { return a.id != b.id ? a.id < b.id : a.version < b.version; };
    if (!std::is_sorted(nodes_.begin(), nodes_.end(), before)) std::stable_sort(nodes_.begin(), nodes_.end(), before);
  }
  // Returns the place of the last version; an invalid one if the node is unknown or deleted.
  osmium::Location place(int64_t id) const {
    const Node* const node = last(id);
    return node ? node->place : osmium::Location();
  }
  bool is_last(int64_t id, uint32_t version) const {
    const Node* const node = last(id);
    return node && node->version == version && node->place.valid();
  }

 private:
  struct Node {
    int64_t id;
    osmium::Location place;
    uint32_t version;
  };
  const Node* last(int64_t id) const {
    const auto after =
        std::upper_bound(nodes_.begin(), nodes_.end(), id, [](int64_t wanted, const Node& n) { return wanted < n.id; });
    return after != nodes_.begin() && (after - 1)->id == id ? &*(after - 1) : nullptr;
  }

  std::vector<Node> nodes_;
};

}  // namespace wavetracer::imports
