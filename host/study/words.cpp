// Rows to phrases.
// Assumes that compare() has set the gains.
#include "study/words.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

std::string reached_words(double gain, double claimed) { return gain >= claimed ? "reached" : "not reached"; }

}  // namespace

const Row* find_row(const std::vector<Row>& rows, const Series& series, uint64_t rays) {
  for (const Row& row : rows)
    if (row.rays == rays && row.series == series) return &row;
  return nullptr;
}

NumberTable gain_table(const std::vector<Row>& rows) {
  NumberTable table{.caption = "Speed against WS with the sort not paid, and in brackets with it paid:",
                    .heads = {"order"},
                    .rows = {}};
  std::vector<uint64_t> counts;
  for (const uint64_t rays : std::set{claimed_few, claimed_many, rows.back().rays})
    if (find_row(rows, unordered(), rays)) counts.push_back(rays);
  for (const uint64_t rays : counts) table.heads.push_back(fmt::format("{} rays", grouped(rays)));
  std::vector<Row> ranked;
  for (const Row& row : rows)
    if (row.rays == rows.back().rays) ranked.push_back(row);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Row& a, const Row& b) { return a.gain_unpaid > b.gain_unpaid; });
  for (const Row& one : ranked) {
    table.rows.push_back({label(one.series)});
    for (const uint64_t rays : counts) {
      const Row* row = find_row(rows, one.series, rays);
      std::string cell = row ? fmt::format("{:.2f}", row->gain_unpaid) : "not measured";
      if (row && one.series.method != "none") cell += fmt::format(" ({:.2f})", row->gain_paid);
      table.rows.back().push_back(cell);
    }
  }
  return table;
}

std::string verdict_words(const std::vector<Row>& rows, const Series& series, uint64_t rays, double claimed_gain) {
  const Row* row = find_row(rows, series, rays);
  if (!row) return "not measured";
  return fmt::format("{} with the sort not paid, {} with it paid", reached_words(row->gain_unpaid, claimed_gain),
                     reached_words(row->gain_paid, claimed_gain));
}

std::vector<Verdict> gain_verdicts(const std::vector<Row>& rows) {
  const Series h3dh = ordered("hilbert3d-histogram");
  return {{fmt::format("H3DH takes 23% less time than WS at {} rays", grouped(claimed_few)),
           verdict_words(rows, h3dh, claimed_few, claimed_gain_few)},
          {fmt::format("H3DH is 2.5 times as fast as WS at {} rays", grouped(claimed_many)),
           verdict_words(rows, h3dh, claimed_many, claimed_gain_many)}};
}

std::string reason_words(const std::vector<Row>& rows) {
  const Row *few = find_row(rows, unordered(), claimed_few), *many = find_row(rows, unordered(), claimed_many);
  if (!few || !many) return "";
  const double fixed = 100 * few->times.unpaid_s / many->times.unpaid_s;
  const std::string start = fmt::format(" The reason: WS takes {:.0f}% of its time at {} rays at {} already, ", fixed,
                                        grouped(claimed_many), grouped(claimed_few));
  if (fixed >= 50)
    return start +
           "which is what launching and the longest single rays cost this device, however few there are; an order can "
           "change the rest alone, and its own launches come on top.";
  return start + "so most of the time at the larger count is that of its rays, which an order can change.";
}

}  // namespace wavetracer::study
