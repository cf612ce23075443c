// Host side of kernels/probe_cache_rate.cl and kernels/probe_thesis_cache.cl.
// Times are those of the kernels by the device's clock, medians; the first run of each is not counted.
#include "cache_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace wavetracer::bench {
namespace {

constexpr uint32_t node_words = 17;
constexpr uint32_t never_put = 0x80000000u;  // keys from here on
constexpr uint32_t stamp = 1;

gpu::Range range(const gpu::Context& context, size_t items) { return {items, context.info().simple_local_size()}; }

// Kernels that no table changes are built with one all the same.
gpu::Definitions plain_definitions() {
  return {{"WT_CACHE_DIVISION", "200000u"}, {"WT_CACHE_HASH_METHOD", "3"}, {"WT_CACHE_CONCURRENT", "1"},
          {"WT_QUESTIONS_PER_ITEM", "1u"}};
}

gpu::Kernel plain_kernel(gpu::Context& context, const char* name) {
  return context.kernel("probe_cache_rate", name, plain_definitions());
}

double seconds_of(gpu::Context& context, uint32_t runs, const std::function<void()>& run) {
  std::vector<double> seconds;
  for (uint32_t i = 0; i <= runs; ++i) {
    context.finish();
    context.reset_profile();
    run();
    const double once = device_seconds(context);
    if (i > 0) seconds.push_back(once);
  }
  return median(seconds);
}

// Questions for keys first .. first + keys - 1, in order or drawn at random.
void ask(gpu::Context& context, Questions& questions, uint32_t first, uint32_t keys, bool draw) {
  const uint32_t count = draw ? questions.count : keys;
  plain_kernel(context, "make_questions")(range(context, count), "bench", first, keys, draw ? 1u : 0u, questions.cells,
                                          questions.left, count);
}

Rate rated(gpu::Context& context, Questions& questions, double seconds) {
  context.fill(questions.outcome, 0);
  plain_kernel(context, "check_answers")(range(context, questions.count), "bench", questions.cells, questions.left,
                                         questions.count, questions.t, questions.primitives, questions.surfaces,
                                         questions.outcome);
  const std::vector<uint32_t> outcome = questions.outcome.read();
  return {questions.count / seconds, outcome[0] / static_cast<double>(questions.count), outcome[1]};
}

// Keys go in by parts, as questions are no more than fit into their buffers. Seconds of all parts.
double put_all(gpu::Context& context, Questions& questions, uint32_t keys,
               const std::function<void(uint32_t count)>& put) {
  double seconds = 0;
  for (uint32_t first = 0; first < keys; first += questions.count) {
    const uint32_t count = std::min(questions.count, keys - first);
    ask(context, questions, first, count, false);
    context.finish();
    context.reset_profile();
    put(count);
    seconds += device_seconds(context);
  }
  return seconds;
}

template <class Clear, class Put>
double median_put(gpu::Context& context, Questions& questions, uint32_t keys, const Clear& clear, const Put& put) {
  std::vector<double> seconds;
  for (uint32_t run = 0; run <= questions.runs; ++run) {
    clear();
    const double all = put_all(context, questions, keys, put);
    if (run > 0) seconds.push_back(all);
  }
  return median(seconds);
}

uint64_t bytes_an_entry(gpu::Context& context, CacheConfig config) {
  config.buffer_size = 4096;
  return make_cache_table(context, config, 1, 1, 1).bytes() / config.buffer_size;
}

CacheConfig sized(gpu::Context& context, CacheConfig config, uint64_t bytes) {
  config.buffer_size = bytes / bytes_an_entry(context, config);
  return config;
}

}  // namespace

Questions make_questions(gpu::Context& context, uint32_t count, uint32_t runs, uint32_t per_item) {
  Questions q;
  q.count = count;
  q.runs = runs;
  q.per_item = per_item;
  q.cells = context.buffer<uint64_t>(count, "cells of questions");
  q.left = context.buffer<uint32_t>(count, "primitives of questions");
  q.t = context.buffer<float>(count, "distances of answers");
  q.primitives = context.buffer<uint32_t>(count, "primitives of answers");
  q.surfaces = context.buffer<uint32_t>(count, "surfaces of answers");
  q.outcome = context.buffer<uint32_t>(2, "outcome");
  return q;
}

TableRates::TableRates(gpu::Context& context, CacheConfig config, uint64_t bytes)
    : context_(context), table_(make_cache_table(context, sized(context, config, bytes), 1, 1u << 20, 1u << 20)) {}

gpu::Kernel TableRates::kernel(const Questions& questions, const char* name, bool bulk, bool writers) const {
  gpu::Definitions definitions = table_.definitions(bulk);
  definitions["WT_QUESTIONS_PER_ITEM"] = fmt::format("{}u", questions.per_item);
  if (writers) definitions["WT_PUT_EVERY"] = "16u";
  return context_.kernel("probe_cache_rate", name, definitions);
}

Rate TableRates::put(Questions& questions) {
  gpu::Kernel run = kernel(questions, "put_questions", false);
  const double seconds = median_put(
      context_, questions, keys(),
      [&] {
        table_.clear(context_);
        table_.counters.write(std::vector<device::wt_cache_counters>(1));
      },
      [&](uint32_t count) {
        run(range(context_, count), "bench", table_.entries, table_.heads, table_.used, table_.device_regions,
            table_.counters, table_.widths, questions.cells, questions.left, count);
      });
  const device::wt_cache_counters counters = table_.counters.read_one(0);
  dropped_ = static_cast<double>(counters.dropped + counters.replaced) / keys();
  return {keys() / seconds};
}

Rate TableRates::find(Questions& questions, bool hit, bool writers, bool bulk) {
  ask(context_, questions, hit ? 0 : never_put, keys(), true);
  gpu::Kernel run = kernel(questions, "find_questions", bulk, writers);
  const uint32_t items = (questions.count + questions.per_item - 1) / questions.per_item;
  const double seconds = seconds_of(context_, questions.runs, [&] {
    run(range(context_, items), "bench", table_.entries, table_.heads, table_.used, table_.device_regions,
        table_.counters, table_.widths, questions.cells, questions.left, questions.count, items, questions.t,
        questions.primitives, questions.surfaces);
  });
  return rated(context_, questions, seconds);
}

Rate TableRates::hash(Questions& questions) {
  ask(context_, questions, 0, keys(), true);
  gpu::Kernel run = kernel(questions, "hash_questions", true);
  const double seconds = seconds_of(context_, questions.runs, [&] {
    run(range(context_, questions.count), "bench", table_.widths, questions.cells, questions.left, questions.count,
        questions.primitives);
  });
  return {questions.count / seconds};
}

ThesisRates::ThesisRates(gpu::Context& context, uint64_t bytes)
    : context_(context),
      nodes_count_(static_cast<uint32_t>(bytes / (4 * node_words))),
      nodes_(context.buffer<uint32_t>(size_t{nodes_count_} * node_words, "thesis nodes")) {}

// So many readers that no lock stays taken: the listing at its best.
gpu::Kernel ThesisRates::kernel(const char* name) const {
  return context_.kernel("probe_thesis_cache", name,
                         {{"WT_NODES", fmt::format("{}u", nodes_count_)}, {"WT_READERS", "0x80000000u"}});
}

Rate ThesisRates::put(Questions& questions) {
  gpu::Kernel run = kernel("thesis_put");
  const auto put = [&](uint32_t count) {
    run(range(context_, count), "bench", nodes_, questions.cells, questions.left, count, stamp, questions.surfaces);
  };
  return {keys() / median_put(context_, questions, keys(), [&] { context_.fill(nodes_, 0); }, put)};
}

Rate ThesisRates::find(Questions& questions, bool hit) {
  ask(context_, questions, hit ? 0 : never_put, keys(), true);
  gpu::Kernel run = kernel("thesis_find");
  const double seconds = seconds_of(context_, questions.runs, [&] {
    run(range(context_, questions.count), "bench", nodes_, questions.cells, questions.left, questions.count, stamp,
        questions.t, questions.primitives, questions.surfaces);
  });
  return rated(context_, questions, seconds);
}

GatherCeilings gather_ceilings(gpu::Context& context, Questions& questions, uint64_t bytes) {
  auto memory = context.buffer<uint64_t>(bytes / 64 * 8, "gathered memory");
  context.fill(memory, 1u);
  const auto rate = [&](const char* name, uint64_t elements) {
    gpu::Kernel run = plain_kernel(context, name);
    return questions.count / seconds_of(context, questions.runs, [&] {
             run(range(context, questions.count), "bench", memory, static_cast<uint32_t>(elements), questions.count,
                 questions.primitives);
           });
  };
  return {rate("gather_slots", bytes / 64), rate("gather_words", bytes / 64 * 8)};
}

}  // namespace wavetracer::bench
