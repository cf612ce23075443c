// Rows to phrases.
// Assumes that compare() has set the gains.
#include "recipes/words.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include "recipes/ray_counts.hpp"
#include "recipes/table.hpp"

namespace wavetracer::recipes {
namespace {

std::string percent_words(double gain) {
  const double less = reduction_percent(gain);
  if (std::abs(less) < 0.5) return "the same time";
  return fmt::format("{:.0f}% {} time", std::abs(less), less > 0 ? "less" : "more");
}

std::string reached_words(double gain, double claimed) { return gain >= claimed ? "reached" : "not reached"; }

}  // namespace

const Row* find_row(const std::vector<Row>& rows, const Series& series, uint64_t rays) {
  for (const Row& row : rows)
    if (row.rays == rays && row.series == series) return &row;
  return nullptr;
}

std::string gain_words(const std::vector<Row>& rows, const Series& series) {
  std::string text;
  for (const uint64_t rays : std::set{claimed_few, claimed_many, rows.back().rays}) {
    const Row* row = find_row(rows, series, rays);
    if (!row) continue;
    text += fmt::format("{}at {} rays {:.2f} times as fast as WS ({})", text.empty() ? "" : "; ", grouped(rays),
                        row->gain_unpaid, percent_words(row->gain_unpaid));
    if (series.method != "none")
      text += fmt::format(" with the sort not paid and {:.2f} times ({}) with it paid", row->gain_paid,
                          percent_words(row->gain_paid));
  }
  return text;
}

std::string verdict_words(const std::vector<Row>& rows, const Series& series, uint64_t rays, const std::string& claim,
                          double claimed_gain) {
  const std::string start = fmt::format("{} at {} rays: ", claim, grouped(rays));
  const Row* row = find_row(rows, series, rays);
  if (!row) return start + "not measured";
  return fmt::format("{}{} with the sort not paid, {} with it paid", start,
                     reached_words(row->gain_unpaid, claimed_gain), reached_words(row->gain_paid, claimed_gain));
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

std::string ranking_words(const std::vector<Row>& rows, uint64_t rays, double Row::*gain) {
  std::vector<Row> found;
  for (const Row& row : rows)
    if (row.rays == rays) found.push_back(row);
  std::stable_sort(found.begin(), found.end(), [gain](const Row& a, const Row& b) { return a.*gain > b.*gain; });
  std::string text;
  for (const Row& row : found)
    text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", label(row.series), row.*gain);
  return text;
}

}  // namespace wavetracer::recipes
