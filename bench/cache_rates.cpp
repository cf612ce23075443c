// SPDX-License-Identifier: Apache-2.0
// The host side of probe_cache_rate.cl and probe_thesis_cache.cl of tests/kernels.
// Times are those of the kernels by the device's clock, medians; the first run of each is not counted.
#include "cache_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace wavetracer::bench {
namespace {

constexpr uint32_t node_words = 17;
constexpr uint32_t never_put = 0x80000000u;  // keys from here on were never put
constexpr uint32_t stamp = 1;

gpu::Range range(const gpu::Context& context, size_t items) { return {items, context.info().simple_local_size()}; }

// Kernels that do not depend on a table are also built with one.
gpu::Kernel plain_kernel(gpu::Context& context, const char* name) {
  return context.kernel(
      "probe_cache_rate", name,
      {{"WT_CACHE_DIVISION", "200000u"}, {"WT_CACHE_HASH_METHOD", "3"}, {"WT_CACHE_CONCURRENT", "1"}});
}

double seconds_of(gpu::Context& context, const std::function<void()>& run) {
  context.finish();
  context.reset_profile();
  run();
  return device_seconds(context);
}

double median_seconds(uint32_t runs, const std::function<double()>& run) {
  std::vector<double> seconds;
  for (uint32_t i = 0; i <= runs; ++i) {
    const double once = run();
    if (i > 0) seconds.push_back(once);
  }
  return median(seconds);
}

// askers: see the kernel; 0: key after key.
void ask(gpu::Context& context, Questions& questions, uint32_t first, uint32_t keys, uint32_t askers, uint32_t count) {
  plain_kernel(context, "make_questions")(range(context, count), Stage::transfer, first, keys, askers, questions.cells,
                                          questions.left, count);
}

CacheConfig sized(gpu::Context& context, CacheConfig config, uint64_t bytes) {
  config.buffer_size = 4096;
  const uint64_t bytes_an_entry = make_cache_table(context, config, 1, 1, 1).bytes() / config.buffer_size;
  config.buffer_size = bytes / bytes_an_entry;
  return config;
}

}  // namespace

Questions make_questions(gpu::Context& context, uint32_t count, uint32_t runs) {
  Questions q;
  q.count = count;
  q.runs = runs;
  q.cells = context.buffer<uint64_t>(count, "cells of questions");
  q.left = context.buffer<uint32_t>(count, "primitives of questions");
  q.t = context.buffer<float>(count, "distances of answers");
  q.primitives = context.buffer<uint32_t>(count, "primitives of answers");
  q.surfaces = context.buffer<uint32_t>(count, "surfaces of answers");
  q.outcome = context.buffer<uint32_t>(2, "outcome");
  return q;
}

// Keys are put in parts, as the buffers hold a limited number of questions. Returns the seconds of all parts.
double RatedTable::fill(Questions& questions) {
  clear();
  double seconds = 0;
  for (uint32_t first = 0; first < keys(); first += questions.count) {
    const uint32_t count = std::min(questions.count, keys() - first);
    ask(context_, questions, first, keys(), 0, count);
    seconds += seconds_of(context_, [&] { put_questions(questions, count); });
  }
  return seconds;
}

Rate RatedTable::put(Questions& questions) {
  const double seconds = median_seconds(questions.runs, [&] { return fill(questions); });
  const auto there = static_cast<double>(kept());
  return {keys() / seconds, there / seconds, there / keys(), 0};
}

Rate RatedTable::find(Questions& questions, const Traffic& traffic) {
  const double seconds = median_seconds(questions.runs, [&] {
    if (wears() && traffic.readers != no_wear) fill(questions);
    ask(context_, questions, traffic.stored ? 0 : never_put, keys(), traffic.askers, questions.count);
    return seconds_of(context_, [&] { find_questions(questions, traffic.readers); });
  });
  context_.fill(questions.outcome, 0);
  plain_kernel(context_, "check_answers")(range(context_, questions.count), Stage::transfer, questions.cells,
                                          questions.left, questions.count, questions.t, questions.primitives,
                                          questions.surfaces, questions.outcome);
  const std::vector<uint32_t> outcome = questions.outcome.read();
  const uint32_t answered = outcome[0], wrong = outcome[1];
  const uint32_t right = traffic.stored ? answered - wrong : questions.count - answered;
  return {questions.count / seconds, right / seconds, answered / static_cast<double>(questions.count), wrong};
}

OurTable::OurTable(gpu::Context& context, const CacheConfig& config, uint64_t bytes)
    : RatedTable(context), table_(make_cache_table(context, sized(context, config, bytes), 1, 1u << 20, 1u << 20)) {}

void OurTable::clear() {
  table_.clear(context_);
  table_.counters.write(std::vector<device::wt_cache_counters>(1));
}

void OurTable::put_questions(Questions& questions, uint32_t count) {
  gpu::Definitions definitions = table_.definitions(false);
  definitions["WT_CACHE_TALLY"] = "1";
  context_.kernel("probe_cache_rate", "put_questions", definitions)(
      range(context_, count), Stage::transfer, table_.entries, table_.heads, table_.used, table_.device_regions,
      table_.counters, table_.widths, questions.cells, questions.left, count);
}

void OurTable::find_questions(Questions& questions, uint32_t readers) {
  table_.config.readers_number = readers;
  context_.kernel("probe_cache_rate", "find_questions", table_.definitions(true))(
      range(context_, questions.count), Stage::transfer, table_.entries, table_.heads, table_.used,
      table_.device_regions, table_.counters, table_.widths, questions.cells, questions.left, questions.count,
      questions.t, questions.primitives, questions.surfaces);
}

uint64_t OurTable::kept() {
  const device::wt_cache_counters counters = table_.counters.read_one(0);
  return counters.stored - counters.replaced;
}

double OurTable::hash(Questions& questions) {
  ask(context_, questions, 0, keys(), 1, questions.count);
  gpu::Kernel run = context_.kernel("probe_cache_rate", "hash_questions", table_.definitions(true));
  return questions.count / median_seconds(questions.runs, [&] {
           return seconds_of(context_, [&] {
             run(range(context_, questions.count), Stage::transfer, table_.widths, questions.cells, questions.left,
                 questions.count, questions.primitives);
           });
         });
}

ThesisTable::ThesisTable(gpu::Context& context, uint64_t bytes)
    : RatedTable(context),
      node_count_(static_cast<uint32_t>(bytes / (4 * node_words))),
      nodes_(context.buffer<uint32_t>(size_t{node_count_} * node_words, "thesis nodes")),
      written_(context.buffer<uint32_t>(1, "thesis nodes written")) {}

gpu::Kernel ThesisTable::kernel(const char* name, uint32_t readers) const {
  return context_.kernel("probe_thesis_cache", name,
                         {{"WT_NODES", fmt::format("{}u", node_count_)}, {"WT_READERS", fmt::format("{}u", readers)}});
}

void ThesisTable::put_questions(Questions& questions, uint32_t count) {
  kernel("thesis_put", no_wear)(range(context_, count), Stage::transfer, nodes_, questions.cells, questions.left, count,
                                stamp, questions.surfaces);
}

void ThesisTable::find_questions(Questions& questions, uint32_t readers) {
  kernel("thesis_find", readers)(range(context_, questions.count), Stage::transfer, nodes_, questions.cells,
                                 questions.left, questions.count, stamp, questions.t, questions.primitives,
                                 questions.surfaces);
}

uint64_t ThesisTable::kept() {
  context_.fill(written_, 0);
  kernel("thesis_count", no_wear)(range(context_, node_count_), Stage::transfer, nodes_, written_);
  return written_.read_one(0);
}

GatherRates gather_rates(gpu::Context& context, Questions& questions, uint64_t bytes) {
  auto memory = context.buffer<uint64_t>(bytes / 64 * 8, "gathered memory");
  context.fill(memory, 1u);
  const auto rate = [&](const char* name, uint64_t elements) {
    gpu::Kernel run = plain_kernel(context, name);
    return questions.count / median_seconds(questions.runs, [&] {
             return seconds_of(context, [&] {
               run(range(context, questions.count), Stage::transfer, memory, static_cast<uint32_t>(elements),
                   questions.count, questions.primitives);
             });
           });
  };
  return {rate("gather_slots", bytes / 64), rate("gather_words", bytes / 64 * 8)};
}

}  // namespace wavetracer::bench
