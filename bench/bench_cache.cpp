// bench_cache: rates of the ray cache's tables at load 0.8 over random keys, beside those of the thesis' two locks and
// of random reads from as much memory, and how evenly the hashes spread the rays of a scene. Assumes a quiet machine.
// Times are those of the kernels by the device's clock; "error" counts answers that are not what was stored under
// their key; of spreads it is the share of keys that overflow.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <filesystem>
#include <limits>
#include <optional>

#include "cache_keys.hpp"
#include "cache_rates.hpp"
#include "json_line.hpp"
#include "passes/generate_rays.hpp"
#include "scene/city.hpp"
#include "scene/load.hpp"
#include "tracers.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  uint32_t runs = 7, questions = 0, per_item = 1, rays = 1000000;  // questions 0: what suits the device
  std::vector<uint32_t> sizes_mb;                                  // empty: likewise
};

struct TableCase {
  std::string name;
  CacheConfig config;
};

std::vector<TableCase> table_cases() {
  const auto config = [](const char* kind, const char* locking, uint32_t hash_method) {
    CacheConfig c;
    c.kind = kind;
    c.locking = locking;
    c.hash_method = hash_method;
    c.readers_number = 1u << 31;  // no entry wears out while it is timed
    return c;
  };
  return {{"concurrent", config("concurrent", "", 3)},
          {"concurrent, hash 1", config("concurrent", "", 1)},
          {"concurrent, hash 2", config("concurrent", "", 2)},
          {"chained", config("chained", "", 3)},
          {"open, mutex", config("open", "mutex", 3)},
          {"open, readers", config("open", "readers", 3)}};
}

std::string size_name(uint32_t mb) {
  return mb % 1024 == 0 ? fmt::format("{} GB", mb / 1024) : fmt::format("{} MB", mb);
}

class Bench {
 public:
  Bench(const Options& options, std::string command)
      : options_(options),
        command_(std::move(command)),
        context_(options.device),
        questions_(make_questions(context_,
                                  options.questions ? options.questions : 1u << (context_.info().cpu ? 20 : 26),
                                  options.runs, options.per_item)) {}

  void run() {
    std::vector<uint32_t> sizes = options_.sizes_mb;
    if (sizes.empty()) sizes = {16, 256, 4096};
    if (options_.sizes_mb.empty() && context_.info().cpu) sizes.pop_back();
    for (const uint32_t mb : sizes) {
      const uint64_t bytes = uint64_t{mb} << 20;
      if (bytes > context_.info().max_buffer) {
        fmt::print(stderr, "bench_cache: {} has no buffer of {}; that size is left out\n", context_.info().name,
                   size_name(mb));
        continue;
      }
      rates(size_name(mb), bytes);
    }
    spreads();
  }

 private:
  const Options& options_;
  std::string command_;
  gpu::Context context_;
  Questions questions_;

  struct Baseline {
    std::string name;
    double per_second;
  };

  void line(const std::string& name, const Rate& rate, const std::string& detail,
            const std::optional<Baseline>& baseline, const GatherCeilings& ceilings, uint64_t bytes) {
    Result result;
    result.bench = "cache";
    result.name = name;
    result.device = context_.info().name;
    result.value = rate.per_second * 1e-9;
    result.unit = "G/s";
    result.error = static_cast<double>(rate.wrong);
    result.detail = detail;
    result.extra = {{"bytes", bytes},
                    {"hit_share", rate.hits},
                    {"questions", questions_.count},
                    {"questions_per_item", questions_.per_item},
                    {"gather_slots_g_s", ceilings.slots * 1e-9},
                    {"gather_words_g_s", ceilings.words * 1e-9}};
    if (baseline) {
      result.baseline = baseline->name;
      result.baseline_value = baseline->per_second * 1e-9;
    }
    print(result, command_);
  }

  void rates(const std::string& size, uint64_t bytes) {
    const GatherCeilings ceilings = gather_ceilings(context_, questions_, bytes);
    const Baseline slots{"random reads of 64 bytes", ceilings.slots};
    line(size + ": random reads, slots of 64 bytes", {ceilings.slots}, "", {}, ceilings, bytes);
    line(size + ": random reads, words of 8 bytes", {ceilings.words}, "", {}, ceilings, bytes);

    Rate thesis_put, thesis_hit, thesis_miss;
    {
      ThesisRates thesis(context_, bytes);
      thesis_put = thesis.put(questions_);
      thesis_hit = thesis.find(questions_, true);
      thesis_miss = thesis.find(questions_, false);
    }
    const auto hits = [](const Rate& rate) { return fmt::format("{:.1f}% answered", 100 * rate.hits); };
    line(size + ": thesis' two locks, put", thesis_put, "", {}, ceilings, bytes);
    line(size + ": thesis' two locks, find of keys that were put", thesis_hit, hits(thesis_hit), slots, ceilings,
         bytes);
    line(size + ": thesis' two locks, find of others", thesis_miss, hits(thesis_miss), slots, ceilings, bytes);

    for (const TableCase& c : table_cases()) {
      TableRates table(context_, c.config, bytes);
      const std::string name = size + ": " + c.name;
      const Rate put = table.put(questions_);
      const std::string load = fmt::format("{} entries, {} keys, {:.2f}% of them dropped or displaced", table.entries(),
                                           table.keys(), 100 * table.dropped());
      line(name + ", put", put, load, Baseline{"thesis' two locks", thesis_put.per_second}, ceilings, table.bytes());
      const Rate hit = table.find(questions_, true, false, true), miss = table.find(questions_, false, false, true);
      const auto both = [&](const std::string& what, const Rate& rate, const Rate& thesis) {
        const std::string detail =
            fmt::format("{}; {:.2f} of random 64-byte reads", hits(rate), rate.per_second / ceilings.slots);
        line(name + what, rate, detail, Baseline{"thesis' two locks", thesis.per_second}, ceilings, table.bytes());
        line(name + what + ", against memory", rate, detail, slots, ceilings, table.bytes());
      };
      both(", find-hit", hit, thesis_hit);
      both(", find-miss", miss, thesis_miss);
      if (c.name != "concurrent") continue;
      both(", find-hit as beside writers", table.find(questions_, true, false, false), thesis_hit);
      both(", find-hit beside writers (one operation in 16 a put)", table.find(questions_, true, true, false),
           thesis_hit);
      line(name + ", hash alone", table.hash(questions_), "", {}, ceilings, table.bytes());
    }
  }

  // Rays of segments 1 to 5 from one transmitter.
  void spreads() {
    const std::string munich = options_.shared + "/scenes/munich/munich.xml";
    const bool there = std::filesystem::exists(munich);
    if (!there) fmt::print(stderr, "bench_cache: {} is not there, so the generated city is traced instead\n", munich);
    Config config;
    config.scene.generate = "--seed 1";
    const Scene scene = there ? load_scene_file(munich, {}) : load_scene(config);
    const std::array<double, 3> transmitter_m =
        there ? std::array{45.0, 90.0, 1.5}
              : example_positions(parse_city_options(config.scene.generate)).front().position_m;

    const std::vector<AccelTriangle> triangles = accel_triangles(scene);
    const DeviceScene device_scene = make_device_scene(context_, scene, false);
    OurTracer tracer(context_, device_scene, TraceShape::bvh2, options_.rays);
    RayQueue launched = make_ray_queue(context_, options_.rays, "launched rays");
    GenerateRays(context_, LaunchDirections("hilbert", options_.rays, 1))(launched, 0, {0, 0, 0}, 0, options_.rays);
    std::vector<Ray> rays(options_.rays, {{}, 0, {}, std::numeric_limits<float>::max()});
    for (size_t axis = 0; axis < 3; axis++) {
      const auto plane = launched.planes.read((WT_RAY_DIRECTION + axis) * launched.capacity, rays.size());
      const double origin = transmitter_m[axis] - scene.origin_m[static_cast<int>(axis)];
      for (size_t i = 0; i < rays.size(); i++) {
        rays[i].origin[axis] = static_cast<float>(origin);
        rays[i].direction[axis] = plane[i];
      }
    }
    const CacheConfig defaults;
    std::vector<RayKey> keys;
    for (int depth = 1; depth <= 5 && !rays.empty(); depth++) {
      std::vector<Hit> hits(rays.size());
      tracer.load(rays);
      tracer.run();
      tracer.fetch(hits);
      rays = next_segment(rays, hits, triangles);
      add_keys(keys, rays, hits, triangles, defaults.division);
    }
    const size_t all = keys.size();
    keys = distinct(std::move(keys));
    const auto bits = [](size_t values) { return static_cast<uint32_t>(std::bit_width(values - 1)); };
    const device::wt_cache_widths widths{bits(defaults.division), bits(scene.surfaces.size()), bits(triangles.size())};
    for (uint32_t method = 1; method <= 3; method++) {
      const Spread s = spread(keys, method, widths);
      Result result;
      result.bench = "cache";
      result.name = fmt::format("spread of hash {}, {}", method, there ? "munich" : "city");
      result.device = context_.info().name;
      result.value = s.chi_square;
      result.unit = "chi-square/dof";
      result.better = Better::lower;
      result.baseline = "keys thrown at random";
      result.baseline_value = 1;
      result.error = s.overflow;
      result.detail =
          fmt::format("{} keys of {} rays; {:.1f}% of buckets occupied, longest {}; {:.3g}% overflow at load 0.8",
                      keys.size(), all, 100 * s.occupied, s.longest, 100 * s.overflow);
      result.extra = {
          {"keys", keys.size()}, {"occupied", s.occupied}, {"longest", s.longest}, {"overflow", s.overflow}};
      print(result, command_);
    }
  }
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Rates of the ray cache's tables, and how evenly its hashes spread rays");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "the folder with scenes/munich");
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(3, 1000));
  app.add_option("--sizes", options.sizes_mb, "MB a table; default: 16 256 on CPUs, 16 256 4096 elsewhere")
      ->check(CLI::Range(1, 65536));
  app.add_option("--questions", options.questions, "a launch; default: 2^20 on CPUs, 2^26 elsewhere")
      ->check(CLI::Range(64, 1 << 30));
  app.add_option("--per-item", options.per_item, "questions a work-item")->check(CLI::Range(1, 16));
  app.add_option("--rays", options.rays, "launched for the spread of hashes")->check(CLI::Range(1000, 100000000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Bench(options, bench::command_line(argc, argv)).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_cache: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
