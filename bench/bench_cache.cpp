// SPDX-License-Identifier: Apache-2.0
// bench_cache compares the ray cache's tables with the thesis' as printed, in right answers per second; it also
// measures mixed operations on them, the stages of a cached depth, and how evenly the hashes spread the rays of a
// scene.
// The machine must be quiet. Times are those of the kernels by the device's clock. "error" counts wrong results:
// answers other than what was stored under their key, or outcomes that no order of mixed operations has; for spreads it
// is the share of keys that overflow.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <optional>

#include "cache_keys.hpp"
#include "cache_rates.hpp"
#include "cache_stages.hpp"
#include "json_line.hpp"
#include "passes/cache_mixed.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> cases{"rates", "mixed", "stages", "spreads"};
  uint32_t runs = 7, questions = 0, rays = 1000000;  // questions, operations: 0 means a number that suits the device
  uint64_t operations = 0;
  std::vector<uint32_t> sizes_mb;  // empty means the same
};

struct TableCase {
  std::string name;
  CacheConfig config;
};

TableCase table_case(const std::string& name, CacheKind kind, CacheLocking locking = "readers",
                     uint32_t hash_method = 3) {
  CacheConfig config;
  config.kind = kind;
  config.locking = locking;
  config.hash_method = hash_method;
  return {name, config};
}

const std::vector<TableCase> tables{table_case("concurrent", "concurrent"), table_case("chained", "chained"),
                                    table_case("open, mutex", "open", "mutex"),
                                    table_case("open, readers", "open", "readers")};

// Keys are random, or as rays ask: rays of one cell of directions are next to each other in a launch and need one
// entry. After readers_number reads the thesis' slot answers no more, until it is written again.
const Traffic spread_keys{"keys at random", true, 1, no_wear}, other_keys{"keys never put", false, 1, no_wear};
const std::vector<Traffic> traffics{spread_keys,
                                    other_keys,
                                    {"256 askers a key", true, 256, CacheConfig{}.readers_number},
                                    {"4096 askers a key", true, 4096, CacheConfig{}.readers_number}};

std::string size_name(uint32_t mb) {
  return mb % 1024 == 0 ? fmt::format("{} GB", mb / 1024) : fmt::format("{} MB", mb);
}

class Bench {
 public:
  Bench(const Options& options, std::string command)
      : options_(options), command_(std::move(command)), context_(options.device) {}

  void run() {
    if (wants("rates")) all_rates();
    if (wants("mixed")) mixed();
    if (!wants("stages") && !wants("spreads")) return;
    const SceneRays rays = scene_rays(context_, options_.shared, options_.rays);
    if (wants("stages")) stages(rays);
    if (wants("spreads")) spreads(rays);
  }

 private:
  const Options& options_;
  std::string command_;
  gpu::Context context_;

  bool wants(const char* name) const {
    return std::find(options_.cases.begin(), options_.cases.end(), name) != options_.cases.end();
  }

  Result result(const std::string& name, double value, const char* unit) const {
    Result r;
    r.bench = "cache";
    r.name = name;
    r.device = context_.info().name;
    r.value = value;
    r.unit = unit;
    return r;
  }

  void all_rates() {
    const bool cpu = context_.info().cpu;
    const uint32_t count = options_.questions ? options_.questions : 1u << (cpu ? 20 : 26);
    std::vector<uint32_t> sizes = options_.sizes_mb;
    if (sizes.empty()) sizes = cpu ? std::vector{16u, 256u} : std::vector{16u, 256u, 4096u};
    Questions questions = make_questions(context_, count, options_.runs);
    for (const uint32_t mb : sizes) {
      const uint64_t bytes = uint64_t{mb} << 20;
      if (bytes > context_.info().max_buffer) {
        fmt::print(stderr, "bench_cache: {} has no buffer of {}; that size is left out\n", context_.info().name,
                   size_name(mb));
        continue;
      }
      rates(questions, size_name(mb), bytes);
    }
    hashes(questions, sizes.size() > 1 ? sizes[1] : sizes[0]);
  }

  // Prints one table under one kind of traffic. done: name of the operations that count. thesis: its table under the
  // same traffic.
  void line(const std::string& name, const RatedTable& table, const Rate& rate, const char* done,
            const GatherRates& gathers, const std::optional<Rate>& thesis) const {
    Result r = result(name, rate.right * 1e-9, "G right/s");
    r.error = static_cast<double>(rate.wrong);
    r.detail = fmt::format("{:.4g} G/s in all, {:.2f} of random 64-byte reads; {:.3g}% {}", rate.asked * 1e-9,
                           rate.asked / gathers.slots, 100 * rate.answered, done);
    r.extra = {{"bytes", table.bytes()},
               {"entries", table.entries()},
               {"keys", table.keys()},
               {"asked_g_s", rate.asked * 1e-9},
               {"answered_share", rate.answered},
               {"gather_share", rate.asked / gathers.slots}};
    if (thesis) {
      r.baseline = "thesis' two locks";
      r.baseline_value = thesis->right * 1e-9;
    }
    print(r, command_);
  }

  // Prints puts and finds of random keys beside as many random reads of the 64 bytes of an entry.
  void against_reads(const std::string& name, const Rate& put, const Rate& find, const GatherRates& gathers) const {
    for (const auto& [operation, rate] : {std::pair{"put", &put}, {spread_keys.name.c_str(), &find}}) {
      Result r = result(fmt::format("{}, {}, against random reads", name, operation), rate->asked * 1e-9, "G/s");
      r.error = static_cast<double>(rate->wrong);
      r.baseline = "random reads of 64 bytes";
      r.baseline_value = gathers.slots * 1e-9;
      print(r, command_);
    }
  }

  void rates(Questions& questions, const std::string& size, uint64_t bytes) {
    const GatherRates gathers = gather_rates(context_, questions, bytes);
    Result r = result(size + ": random reads of 64 bytes", gathers.slots * 1e-9, "G/s");
    r.detail = fmt::format("{:.4g} G/s of 8 bytes", gathers.words * 1e-9);
    r.extra = {{"bytes", bytes}, {"questions", questions.count}, {"words_g_s", gathers.words * 1e-9}};
    print(r, command_);

    std::vector<Rate> thesis;
    const auto all = [&](const std::string& name, RatedTable& table) {
      std::vector<Rate> measured{table.put(questions)};
      for (const Traffic& traffic : traffics) measured.push_back(table.find(questions, traffic));
      const bool baseline = !thesis.empty();
      for (size_t i = 0; i < measured.size(); ++i)
        line(fmt::format("{}: {}, {}", size, name, i == 0 ? "put" : traffics[i - 1].name), table, measured[i],
             i == 0 ? "kept" : "answered", gathers, baseline ? std::optional(thesis[i]) : std::nullopt);
      against_reads(fmt::format("{}: {}", size, name), measured[0], measured[1], gathers);
      if (!baseline) thesis = measured;
    };
    {
      ThesisTable table(context_, bytes);
      all("thesis' two locks", table);
    }
    for (const TableCase& c : tables) {
      OurTable table(context_, c.config, bytes);
      all(c.name, table);
    }
  }

  // Measures the cost of the hash, and how many keys find a place by it in the concurrent table.
  void hashes(Questions& questions, uint32_t mb) {
    for (uint32_t method = 1; method <= 3; ++method) {
      OurTable table(context_, table_case("", "concurrent", "readers", method).config, uint64_t{mb} << 20);
      table.put(questions);
      const Rate found = table.find(questions, spread_keys);
      Result r = result(fmt::format("{}: concurrent, hash {}", size_name(mb), method), found.right * 1e-9, "G right/s");
      r.error = static_cast<double>(found.wrong);
      r.detail = fmt::format("{}; {:.4g} G/s in all, {:.1f}% answered; the hash alone {:.4g} G/s", spread_keys.name,
                             found.asked * 1e-9, 100 * found.answered, table.hash(questions) * 1e-9);
      print(r, command_);
    }
  }

  // One launch has three finds per put, an eighth of them with 64 keys; see large_cache_test.cpp.
  void mixed() {
    const uint64_t operations = options_.operations   ? options_.operations
                                : context_.info().cpu ? 2'000'000
                                                      : 100'000'000;
    for (const TableCase& c : tables) {
      const test::TableKind kind{c.config.kind, c.config.locking, "quantised"};
      const test::MixedReport report = test::run_mixed(context_, kind, operations, operations / 8, cache_load);
      const double per_second = static_cast<double>(operations) / report.seconds;
      Result r = result("mixed put and find: " + c.name, per_second * 1e-9, "G/s");
      r.error = static_cast<double>(report.faults.all());
      r.detail = fmt::format("{} operations, {} puts, {} hits, {} puts dropped", operations, report.puts, report.hits,
                             report.dropped);
      r.extra = {{"wrong_answers", report.faults.wrong_answers},
                 {"never_put", report.faults.never_put},
                 {"lost", report.faults.lost},
                 {"miscounted", report.faults.miscounted}};
      print(r, command_);
    }
  }

  void stage(const std::string& name, size_t rays, double seconds, double trace_seconds, const std::string& detail) {
    const double ns_a_ray = 1e9 / static_cast<double>(rays);
    Result r = result(name, seconds * ns_a_ray, "ns/ray");
    r.better = Better::lower;
    r.baseline = "trace of the same rays";
    r.baseline_value = trace_seconds * ns_a_ray;
    r.detail = detail;
    r.extra = {{"rays", rays}};
    print(r, command_);
  }

  void stages(const SceneRays& rays) {
    const auto lines = [&](const std::string& name, bool with_hash, const StageTimes& t) {
      const std::string share = fmt::format("{:.1f}% answered", 100 * t.answered);
      if (with_hash) stage(name + ", hash", t.rays, t.hash, t.trace, fmt::format("{} rays", t.rays));
      stage(name + ", look-up that misses", t.rays, t.lookup_miss, t.trace, "of entries of the depths before");
      stage(name + ", look-up that hits", t.rays, t.lookup_hit, t.trace, share);
      stage(name + ", store", t.rays, t.store, t.trace, "");
    };
    for (const TableCase& c : tables) {
      const std::vector<StageTimes> times = stage_times(context_, rays, c.config, options_.runs);
      const bool first = c.name == tables.front().name;  // per depth; keys and hashes are those of all depths
      StageTimes all;
      for (size_t k = 0; k < times.size(); ++k) {
        const StageTimes& t = times[k];
        if (first) lines(fmt::format("{}, depth {}: {}", rays.name, k + 1, c.name), true, t);
        all.rays += t.rays;
        all.hash += t.hash;
        all.lookup_miss += t.lookup_miss;
        all.lookup_hit += t.lookup_hit;
        all.store += t.store;
        all.trace += t.trace;
        all.answered += t.answered * static_cast<double>(t.rays);
      }
      all.answered /= static_cast<double>(all.rays);
      lines(fmt::format("{}, all depths: {}", rays.name, c.name), first, all);
    }
  }

  void spreads(const SceneRays& rays) {
    const CacheConfig defaults;
    const std::vector<RayKey> keys = distinct_keys(rays, defaults.division);
    const auto bits = [](size_t values) { return static_cast<uint32_t>(std::bit_width(values - 1)); };
    const device::wt_cache_widths widths{bits(defaults.division), bits(rays.scene.surfaces.size()),
                                         bits(rays.scene.triangles.size())};
    for (uint32_t method = 1; method <= 3; method++) {
      const Spread s = spread(keys, method, widths);
      Result r = result(fmt::format("spread of hash {}, {}", method, rays.name), s.chi_square, "chi-square/dof");
      r.better = Better::lower;
      r.baseline = "keys thrown at random";
      r.baseline_value = 1;
      r.error = s.overflow;
      r.detail =
          fmt::format("{} keys of {} rays; {:.1f}% of buckets occupied, longest {}; {:.3g}% overflow at load 0.8",
                      keys.size(), rays.count(), 100 * s.occupied, s.longest, 100 * s.overflow);
      r.extra = {{"keys", keys.size()}, {"occupied", s.occupied}, {"longest", s.longest}, {"overflow", s.overflow}};
      print(r, command_);
    }
  }
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("The ray cache's tables: right answers a second, mixed operations, stages of a frame, spread of hashes");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "the folder with scenes/munich");
  app.add_option("--cases", options.cases, "what to run; default: all")
      ->check(CLI::IsMember({"rates", "mixed", "stages", "spreads"}));
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(3, 1000));
  app.add_option("--sizes", options.sizes_mb, "MB a table; default: 16 256 on CPUs, 16 256 4096 elsewhere")
      ->check(CLI::Range(1, 65536));
  app.add_option("--questions", options.questions, "a launch; default: 2^20 on CPUs, 2^26 elsewhere")
      ->check(CLI::Range(64, 1 << 30));
  app.add_option("--operations", options.operations, "mixed ones; default: 2 * 10^6 on CPUs, 10^8 elsewhere")
      ->check(CLI::Range(1000, 1000000000));
  app.add_option("--rays", options.rays, "launched for stages and spreads")->check(CLI::Range(1000, 100000000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Bench(options, bench::command_line(argc, argv)).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_cache: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
