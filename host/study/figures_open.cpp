// Figures 6.6 to 6.9: the open-addressed table in a standing scene.
// Claims: A. Zhdanov, TU Munich, 2014, section 6.3.1, "Analysis of Open-Addressed Table Performance".
#include <fmt/format.h>
#include <algorithm>
#include "study/figures_tables.hpp"
#include "study/ray_counts.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {
namespace {

const std::vector<std::string> mutexes = {"mutex uniform", "mutex Morton", "mutex mixed"};
const std::vector<std::string> readers = {"readers uniform", "readers Morton", "readers mixed"};

std::vector<std::string> with_chained() {
  std::vector<std::string> all = mutexes;
  all.push_back(chained(3).name);
  return all;
}

bool open_is_cheaper(const std::vector<CacheRow>& rows, double (*operation)(const CacheRow&)) {
  const CacheRow *open = find_cached(rows, "mutex mixed", rows.front().rays, rows.front().drive),
                 *chain = find_cached(rows, chained(3).name, rows.front().rays, rows.front().drive);
  return open && chain && operation(*open) < operation(*chain);
}

Findings show_operations(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "The thesis finds most writes to the open table to take three times as long as most reads (60 ms against 20 ms), "
      "and both to take less than in the chained table (section 6.3.1, figure 6.6). Measured on {} at {} rays.",
      measured.device.name, grouped(rows.front().rays));
  const std::vector<Verdict> verdicts = {
      {"writes take longer than reads",
       settings_verdict(rows, mutexes, [](const CacheRow& row) { return write_ns(row) > read_ns(row); })},
      {"writes take less than in the chained table, with the mixed hash", verdict(open_is_cheaper(rows, write_ns))},
      {"reads take less than in the chained table, with the mixed hash", verdict(open_is_cheaper(rows, read_ns))}};
  return operations_findings(recipe, measured, request, with_chained(), {paragraph, verdicts}, false);
}

Findings show_tracing(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::string paragraph = fmt::format(
      "The thesis finds operations of the open table much faster than tracing, 1 to 2.5 s against some 0.06 s (section "
      "6.3.1, figure 6.7). Measured on {} at {} rays.",
      measured.device.name, grouped(rows.front().rays));
  return operations_findings(recipe, measured, request, with_chained(), {paragraph, trace_verdicts(rows, mutexes)},
                             true);
}

// Where every number of rays of a list has it: "confirmed", "not confirmed", "not measured" for an empty list.
std::string everywhere(const std::vector<uint64_t>& rays, const AtRays& holds) {
  return rays.empty() ? "not measured" : verdict(std::all_of(rays.begin(), rays.end(), holds));
}

std::vector<uint64_t> above(const std::vector<uint64_t>& rays, uint64_t bound) {
  std::vector<uint64_t> out;
  for (const uint64_t count : rays)
    if (count > bound) out.push_back(count);
  return out;
}

Findings show_readers(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::vector<uint64_t> rays = rays_of(rows), many = above(rays, 50000);
  const auto saves = [&](uint64_t count) { return any_saves(rows, readers, count, rows.front().drive); };
  const auto mixed_first = [&](uint64_t count) {
    return fastest(rows, readers, count, rows.front().drive) == "readers mixed";
  };
  const std::string paragraph = fmt::format(
      "The thesis finds the open table with two locks to save time from some 50,000 rays on, most with the mixed hash, "
      "then with the uniform one, then with Morton codes (section 6.3.1, figure 6.8). Measured on {} with a warm "
      "table, one of them saves time {}.",
      measured.device.name, where_words(rays, saves));
  return time_findings(recipe, measured, request,
                       {paragraph,
                        {{"a gain beyond 50,000 rays", everywhere(many, saves)},
                         {"the mixed hash is the fastest beyond 50,000 rays", everywhere(many, mixed_first)}}});
}

Findings show_ordered(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  const auto& rows = measured.rows;
  const std::vector<uint64_t> rays = rays_of(rows), many = above(rays, 16000);
  const auto saves = [&](uint64_t count) { return any_saves(rows, mutexes, count, rows.front().drive); };
  const std::string paragraph = fmt::format(
      "With a mutex and rays in order (H3DH), the thesis finds the open table to save time from some 16,000 rays on, "
      "2 s at most at 2,048,000 (section 6.3.1, figure 6.9). Measured on {} with a warm table, one of them saves time "
      "{}.",
      measured.device.name, where_words(rays, saves));
  return time_findings(recipe, measured, request,
                       {paragraph, {{"a gain beyond 16,000 rays", everywhere(many, saves)}}});
}

CacheStudy rays_study(const std::string& name) {
  return {.name = name, .settings = {}, .rays = doubling_rays(), .few_rays = few_doubling_rays(), .at_once = 4};
}

}  // namespace

std::vector<Recipe> open_figures() {
  const auto operations = std::make_shared<const CacheStudy>(
      CacheStudy{.name = "open-operations",
                 .settings = {no_cache(), open_mutex(1), open_mutex(2), open_mutex(3), chained(3)},
                 .rays = {anatomy_rays},
                 .few_rays = {anatomy_rays},
                 .by_depth = true});
  CacheStudy unordered = rays_study("open-rays"), ordered = rays_study("open-rays-ordered");
  unordered.settings = {no_cache(), open_readers(1), open_readers(2), open_readers(3), ours(), born_in_order()};
  ordered.settings = {with_order(no_cache()), with_order(open_mutex(1)), with_order(open_mutex(2)),
                      with_order(open_mutex(3)), with_order(ours())};
  return {{.name = "figure-6.6",
           .doc = "open cache: what a write and a read of a segment take, by hash",
           .title = "Operations of the open table",
           .series = {},
           .study = operations,
           .view = show_operations},
          {.name = "figure-6.7",
           .doc = "open cache: writes and reads against tracing",
           .title = "Operations of the open table and tracing",
           .series = {},
           .study = operations,
           .view = show_tracing},
          {.name = "figure-6.8",
           .doc = "open cache with two locks against none, 1,000 to 20,480,000 rays, by hash",
           .title = "Frames with the open table",
           .series = {},
           .study = std::make_shared<const CacheStudy>(unordered),
           .view = show_readers},
          {.name = "figure-6.9",
           .doc = "open cache with a mutex against none, rays in order",
           .title = "Frames with the open table, rays in order",
           .series = {},
           .study = std::make_shared<const CacheStudy>(ordered),
           .view = show_ordered}};
}

}  // namespace wavetracer::study
