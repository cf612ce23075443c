// SPDX-License-Identifier: Apache-2.0
// The ray cache as the thesis prints it (A. Zhdanov, TU Munich, 2014, listings C.1 to C.3), for tests of its faults. It
// is transcribed without changes, with 32-bit int and 64-bit long; sums and products wrap as they did on the GPU.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace wavetracer::test::thesis {

inline int32_t times(int32_t a, int32_t b) {
  return static_cast<int32_t>(static_cast<uint32_t>(a) * static_cast<uint32_t>(b));
}
inline int64_t times(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) * static_cast<uint64_t>(b));
}
inline int64_t plus(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}

inline uint32_t separateBy4(uint32_t x) {
  x &= 0x0000007f;
  x = (x ^ (x << 16)) & 0x0070000F;
  x = (x ^ (x << 8)) & 0x40300C03;
  x = (x ^ (x << 4)) & 0x42108421;
  return x;
}

inline uint32_t mortonCode5(uint32_t x, uint32_t y, uint32_t z, uint32_t u, uint32_t v) {
  return separateBy4(x) | (separateBy4(y) << 1) | (separateBy4(z) << 2) | (separateBy4(u) << 3) | (separateBy4(v) << 4);
}

struct CacheKey {
  uint32_t primitiveIndex = 0, instanceId = 0, div_x = 0, div_y = 0, div_z = 0;
  uint32_t hash = 0;

  CacheKey() = default;
  CacheKey(uint32_t instance, uint32_t primitive, float x, float y, float z, int hash_method, int div = 200000)
      : primitiveIndex(primitive), instanceId(instance) {
    const auto cells = static_cast<float>(div);
    div_x = static_cast<uint32_t>((x + 1) * cells / 2);
    div_y = static_cast<uint32_t>((y + 1) * cells / 2);
    div_z = static_cast<uint32_t>((z + 1) * cells / 2);
    hash = hash_method == 2 ? calc_hash2() : hash_method == 3 ? calc_hash3() : calc_hash1();
  }

  uint32_t calc_hash1() const {
    const int32_t x[5] = {static_cast<int32_t>(primitiveIndex), static_cast<int32_t>(instanceId),
                          static_cast<int32_t>(div_x), static_cast<int32_t>(div_y), static_cast<int32_t>(div_z)};
    const int64_t p = (int64_t{1} << 32) - 5, z = 0x64b6055a;
    const int32_t z2 = 0x5067d19d;
    int64_t s = 0, zi = 1;
    for (const int32_t number : x) {
      const int64_t xi = times(number, z2) >> 1;
      s = plus(s, times(zi, xi)) % p;
      zi = times(zi, z) % p;
    }
    s = plus(s, times(zi, p - 1)) % p;
    return static_cast<uint32_t>(s);
  }
  uint32_t calc_hash2() const { return mortonCode5(div_x, div_y, div_z, instanceId, primitiveIndex); }
  uint32_t calc_hash3() const { return calc_hash1() + calc_hash2(); }

  bool operator==(const CacheKey& other) const {
    return primitiveIndex == other.primitiveIndex && instanceId == other.instanceId && div_x == other.div_x &&
           div_y == other.div_y && div_z == other.div_z;
  }
};

inline uint32_t getBucketIndex(uint32_t hash, int num_of_buckets) {
  return static_cast<uint32_t>((static_cast<float>(hash) / static_cast<float>(std::numeric_limits<uint32_t>::max())) *
                               static_cast<float>(num_of_buckets - 1) / 2);
}

// The same of the chained table, whose hash is signed and gets one more before it is halved (section 5.2.2).
inline uint32_t getSignedBucketIndex(uint32_t hash, int num_of_buckets) {
  return static_cast<uint32_t>(
      (static_cast<float>(static_cast<int32_t>(hash)) / static_cast<float>(std::numeric_limits<int32_t>::max()) + 1) *
      static_cast<float>(num_of_buckets - 1) / 2);
}

// Listing C.2 for one stream at a time, with what it stores as one number. Nodes know their key's hash, not the key.
class ChainedTable {
 public:
  struct Node {
    uint32_t hash = 0, data = 0;
    bool used = false;
    int left = -1, right = -1, queue = -1, counter = 0;
  };

  std::vector<Node> nodes;

  ChainedTable(int buckets, int load)
      : nodes(static_cast<size_t>(buckets) * static_cast<size_t>(load)), buckets_(buckets) {}

  // previous: cachedNodeWrite, the node of the segment before.
  void writeToCache(const CacheKey& key, uint32_t data, int& previous) {
    const int bucket = static_cast<int>(getSignedBucketIndex(key.hash, buckets_));
    int root = bucket, node = -1;
    if (!at(root).used) {
      fill(root, key, data);
      node = root;
      ++at(root).counter;
    } else {
      node = bucket + at(root).counter++ * buckets_;
      if (node >= static_cast<int>(nodes.size())) return;
      fill(node, key, data);
      for (;;) {
        int& link = at(node).hash <= at(root).hash ? at(root).left : at(root).right;
        if (link == -1) {
          link = node;
          return;  // before the path is linked
        }
        root = link;
      }
    }
    if (previous != -1) at(previous).queue = node;
    previous = node;
  }

  std::optional<uint32_t> getFromCache(const CacheKey& key) const {
    int root = static_cast<int>(getSignedBucketIndex(key.hash, buckets_));
    if (!at(root).used) return {};
    for (;;) {
      if (at(root).hash == key.hash) return at(root).data;  // "equals"
      const int next = key.hash <= at(root).hash ? at(root).left : at(root).right;
      if (next == -1) return {};
      root = next;
    }
  }

 private:
  int buckets_;
  Node& at(int i) { return nodes[static_cast<size_t>(i)]; }
  const Node& at(int i) const { return nodes[static_cast<size_t>(i)]; }
  void fill(int i, const CacheKey& key, uint32_t data) {
    at(i).hash = key.hash;
    at(i).data = data;
    at(i).used = true;
  }
};

struct Point {
  float x, y, z;
};

inline float calculateResidual(Point a, Point b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
}

// Listing C.3 for one stream at a time. It stores a number, and the place where the result begins (data.nextOrigin).
class OpenTable {
 public:
  struct Node {
    uint32_t hash = 0, data = 0, pos_hash = 0;
    Point nextOrigin{};
    int writeLock = 0, readLock = 0;
    uint32_t readN = 0;
    bool used = false;  // the listing does not define an unused node; here it is no answer
  };

  OpenTable(int buckets, uint32_t readers, float residual)
      : nodes_(static_cast<size_t>(buckets)), readers_(readers), residual_(residual) {}

  bool writeToCache(const CacheKey& key, uint32_t data, Point nextOrigin, uint32_t pos_hash) {
    Node& node = at(key);
    if (node.writeLock != 0) return false;
    node.writeLock = 1;
    node.hash = key.hash;
    node.data = data;
    node.nextOrigin = nextOrigin;
    node.pos_hash = pos_hash;
    node.used = true;
    node.readLock = 0;
    return true;
  }

  std::optional<uint32_t> getFromCache(const CacheKey& key, uint32_t pos_hash) {
    return read(at(key), at(key).pos_hash == pos_hash);
  }

  std::optional<uint32_t> getFromCacheRes(const CacheKey& key, Point nextOrigin) {
    Node& node = at(key);
    return read(node, node.hash == key.hash || calculateResidual(node.nextOrigin, nextOrigin) <= residual_);
  }

 private:
  std::vector<Node> nodes_;
  uint32_t readers_;
  float residual_;
  Node& at(const CacheKey& key) { return nodes_[getBucketIndex(key.hash, static_cast<int>(nodes_.size()))]; }

  std::optional<uint32_t> read(Node& node, bool valid) {
    if (node.readLock != 0) return {};
    node.readLock = 1;
    if (!valid) {
      node.readN = 0;
      node.writeLock = 0;
      return {};
    }
    const uint32_t i = node.readN++;
    if (i < readers_ - 1) {
      node.readLock = 0;
    } else {
      node.readN = 0;
      node.writeLock = 0;
    }
    if (!node.used) return {};
    return node.data;
  }
};

// Algorithm 4: it computes a distance and tests one component.
inline bool withinByAlgorithm4(Point receiver, Point position, float radius) {
  const float dx = std::abs(receiver.x - position.x);
  return dx <= radius;
}

// checkIntersections of listing C.3: a cube.
inline bool withinByListing(Point receiver, Point position, float R) {
  const float dx = std::abs(receiver.x - position.x), dy = std::abs(receiver.y - position.y),
              dz = std::abs(receiver.z - position.z);
  return dx < R && dy < R && dz < R;
}

}  // namespace wavetracer::test::thesis
