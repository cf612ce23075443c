// Rates of one table of the ray cache, and of the thesis' as printed: what of bench_cache runs on the device.
// Assumes that a table is filled to a load of 0.8 with the keys 0, 1, 2, ... before it is asked.
#pragma once
#include <string>

#include "passes/cache_table.hpp"
#include "timing.hpp"

namespace wavetracer::bench {

constexpr double cache_load = 0.8;

// Questions and answers, shared by all tables.
struct Questions {
  uint32_t count = 0, runs = 0;
  gpu::Buffer<uint64_t> cells;
  gpu::Buffer<uint32_t> left, primitives, surfaces, outcome;
  gpu::Buffer<float> t;
};
Questions make_questions(gpu::Context& context, uint32_t count, uint32_t runs);

// Which keys are asked for.
struct Traffic {
  std::string name;
  bool stored;       // keys that were put, or others
  uint32_t askers;   // so many in a row ask for one key, then for another, drawn at random
  uint32_t readers;  // cache.readers_number, of tables that wear out; those are filled anew before each run
};
constexpr uint32_t no_wear = 1u << 31;  // readers of an entry

struct Rate {
  double asked = 0;     // operations a second
  double right = 0;     // of these, with the answer of the right key, or none where it was never put; puts: kept
  double answered = 0;  // share of the operations
  uint64_t wrong = 0;   // answers that are not what was stored under their key
};

// A table that can be filled and asked.
class RatedTable {
 public:
  virtual ~RatedTable() = default;
  // Puts all keys into the cleared table.
  Rate put(Questions& questions);
  // The table was filled.
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
  virtual uint64_t kept() = 0;  // keys in the table
  virtual bool wears() const = 0;
  double fill(Questions& questions);
};

// One of ours in the memory of `bytes` bytes.
class OurTable : public RatedTable {
 public:
  OurTable(gpu::Context& context, const CacheConfig& config, uint64_t bytes);
  uint32_t entries() const override { return table_.regions[0].entries; }
  uint64_t bytes() const override { return table_.bytes(); }
  // Evaluations of the hash alone, a second.
  double hash(Questions& questions);

 private:
  CacheTable table_;
  void clear() override;
  void put_questions(Questions& questions, uint32_t count) override;
  void find_questions(Questions& questions, uint32_t readers) override;
  uint64_t kept() override;
  bool wears() const override { return table_.config.kind == "open" && table_.config.locking == "readers"; }
};

// The table of listing C.3, of nodes of 68 bytes.
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

// Random reads a second from a buffer of so many bytes: slots of 64 bytes, words of 8.
struct GatherRates {
  double slots = 0, words = 0;
};
GatherRates gather_rates(gpu::Context& context, Questions& questions, uint64_t bytes);

}  // namespace wavetracer::bench
