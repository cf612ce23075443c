// Rates of one table of the ray cache, and of the thesis' as printed: what of bench_cache runs on the device.
// Assumes that a table is filled to a load of 0.8 with the keys 0, 1, 2, ... before it is asked.
#pragma once
#include <array>
#include <string>

#include "passes/cache_table.hpp"
#include "timing.hpp"

namespace wavetracer::bench {

constexpr double cache_load = 0.8;

// Questions and answers, shared by all tables.
struct Questions {
  uint32_t count = 0, runs = 0, per_item = 1;
  gpu::Buffer<uint64_t> cells;
  gpu::Buffer<uint32_t> left, primitives, surfaces, outcome;
  gpu::Buffer<float> t;
};
Questions make_questions(gpu::Context& context, uint32_t count, uint32_t runs, uint32_t per_item);

struct Rate {
  double per_second = 0;
  double hits = 0;     // share of the questions
  uint64_t wrong = 0;  // hits that are not what was stored under their key
};

// One table in the memory of `bytes` bytes.
class TableRates {
 public:
  TableRates(gpu::Context& context, CacheConfig config, uint64_t bytes);
  uint32_t entries() const { return table_.regions[0].entries; }
  uint32_t keys() const { return static_cast<uint32_t>(cache_load * entries()); }
  uint64_t bytes() const { return table_.bytes(); }
  // Writes of a second into the cleared table, of all its keys. Leaves it filled.
  Rate put(Questions& questions);
  // Questions for keys that were put, or never were. writers: with one put in 16 blocks of questions.
  Rate find(Questions& questions, bool hit, bool writers, bool bulk);
  // Evaluations of the hash alone.
  Rate hash(Questions& questions);
  // Share of the keys that the last put dropped, or that others displaced.
  double dropped() const { return dropped_; }

 private:
  gpu::Context& context_;
  CacheTable table_;
  double dropped_ = 0;
  gpu::Kernel kernel(const Questions& questions, const char* name, bool bulk, bool writers = false) const;
};

// The table of listing C.3, of nodes of 68 bytes.
class ThesisRates {
 public:
  ThesisRates(gpu::Context& context, uint64_t bytes);
  uint32_t keys() const { return static_cast<uint32_t>(cache_load * nodes_count_); }
  Rate put(Questions& questions);
  Rate find(Questions& questions, bool hit);

 private:
  gpu::Context& context_;
  uint32_t nodes_count_;
  gpu::Buffer<uint32_t> nodes_;
  gpu::Kernel kernel(const char* name) const;
};

// Random reads of a second from a buffer of so many bytes: slots of 64 bytes, words of 8.
struct GatherCeilings {
  double slots = 0, words = 0;
};
GatherCeilings gather_ceilings(gpu::Context& context, Questions& questions, uint64_t bytes);

}  // namespace wavetracer::bench
