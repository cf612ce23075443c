// SPDX-License-Identifier: Apache-2.0
// Rates of one table of the ray cache, and of the thesis' as printed: the part of bench_cache that runs on the device.
// A table is filled to a load of 0.8 with the keys 0, 1, 2, ... before it is asked.
#pragma once
#include <string>

#include "passes/cache_table.hpp"
#include "timing.hpp"

namespace wavetracer::bench {

constexpr double cache_load = 0.8;

// Questions and answers, which all tables share.
struct Questions {
  uint32_t count = 0, runs = 0;
  gpu::Buffer<uint64_t> cells;
  gpu::Buffer<uint32_t> left, primitives, surfaces, outcome;
  gpu::Buffer<float> t;
};
Questions make_questions(gpu::Context& context, uint32_t count, uint32_t runs);

// The keys that are asked for.
struct Traffic {
  std::string name;
  bool stored;       // keys that were put, or others
  uint32_t askers;   // this many askers in a row ask for one key, then for another random one
  uint32_t readers;  // cache.readers_number, for tables that wear out; those are filled again before each run
};
constexpr uint32_t no_wear = 1u << 31;  // readers of an entry

struct Rate {
  double asked = 0;  // operations per second
  double right = 0;  // rate of operations with the answer of the right key, or none if it was never put; for puts: rate
                     // of kept ones
  double answered = 0;  // share of the operations
  uint64_t wrong = 0;   // answers other than what was stored under their key
};

// A table that can be filled and asked.
class RatedTable {
 public:
  virtual ~RatedTable() = default;
  // Puts all keys into the cleared table.
  Rate put(Questions& questions);
  // The table must be filled.
  Rate find(Questions& questions, const Traffic& traffic);
  virtual uint32_t entries() const = 0;
  virtual uint64_t bytes() const = 0;
  uint32_t keys() const { return static_cast<uint32_t>(cache_load * entries()); }

 protected:
  explicit RatedTable(gpu::Context& context) : context_(context) {}
  gpu::Context& context_;

 private:
  virtual void clear() = 0;
  virtual void put_questions(Questions& questions, uint32_t count) = 0;
  virtual void find_questions(Questions& questions, uint32_t readers) = 0;
  virtual uint64_t kept() = 0;  // number of keys in the table
  virtual bool wears() const = 0;
  double fill(Questions& questions);
};

// One of our tables with `bytes` bytes of memory.
class OurTable : public RatedTable {
 public:
  OurTable(gpu::Context& context, const CacheConfig& config, uint64_t bytes);
  uint32_t entries() const override { return table_.regions[0].entries; }
  uint64_t bytes() const override { return table_.bytes(); }
  // Returns evaluations of the hash alone per second.
  double hash(Questions& questions);

 private:
  CacheTable table_;
  void clear() override;
  void put_questions(Questions& questions, uint32_t count) override;
  void find_questions(Questions& questions, uint32_t readers) override;
  uint64_t kept() override;
  bool wears() const override { return table_.config.in_slots() && !table_.config.locks(); }
};

// The table of listing C.3, with nodes of 68 bytes.
class ThesisTable : public RatedTable {
 public:
  ThesisTable(gpu::Context& context, uint64_t bytes);
  uint32_t entries() const override { return node_count_; }
  uint64_t bytes() const override { return nodes_.bytes(); }

 private:
  uint32_t node_count_;
  gpu::Buffer<uint32_t> nodes_, written_;
  gpu::Kernel kernel(const char* name, uint32_t readers) const;
  void clear() override { context_.fill(nodes_, 0); }
  void put_questions(Questions& questions, uint32_t count) override;
  void find_questions(Questions& questions, uint32_t readers) override;
  uint64_t kept() override;
  bool wears() const override { return true; }
};

// Random reads per second from a buffer of this size: slots of 64 bytes, words of 8.
struct GatherRates {
  double slots = 0, words = 0;
};
GatherRates gather_rates(gpu::Context& context, Questions& questions, uint64_t bytes);

}  // namespace wavetracer::bench
