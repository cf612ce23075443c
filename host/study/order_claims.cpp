// SPDX-License-Identifier: Apache-2.0
// Turns rows into phrases. Factors have two decimals.
// compare() must have set the gains.
#include "study/order_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <set>
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

using Rows = std::vector<OrderRow>;
using Gain = double OrderRow::*;

constexpr double negligible_gain = 0.05;

std::string paid_and_not(const char* unpaid, const char* paid) {
  return fmt::format("{} with the sort not paid, {} with it paid", unpaid, paid);
}

// Judges both gains.
template <class Holds>
Judge<OrderRow> both_gains(Holds holds) {
  return [holds](const Rows& rows) {
    Tally tally;
    const auto word = [&](Gain gain) {
      const bool yes = holds(rows, gain);
      tally.add(yes);
      return yes ? "yes" : "no";
    };
    const char *unpaid = word(&OrderRow::gain_unpaid), *paid = word(&OrderRow::gain_paid);
    return Judgement{tally.outcome(), paid_and_not(unpaid, paid)};
  };
}

double gain_at(const Rows& rows, const std::string& method, uint64_t rays, Gain gain) {
  return find_row(rows, ordered(method), rays)->*gain;
}

double gain_of(const Rows& rows, const std::string& method, Gain gain) {
  return gain_at(rows, method, rows.back().rays, gain);
}

// Returns the numbers of rays that were measured, from `first` to `last`.
std::set<uint64_t> counts_between(const Rows& rows, uint64_t first, uint64_t last) {
  std::set<uint64_t> counts;
  for (const OrderRow& row : rows)
    if (row.rays >= first && row.rays <= last) counts.insert(row.rays);
  return counts;
}

std::string reason(const Rows& rows) {
  const OrderRow *few = find_row(rows, unordered(), claimed_few), *many = find_row(rows, unordered(), claimed_many);
  if (!few || !many) return "";
  const double fixed = 100 * few->times.unpaid_s / many->times.unpaid_s;
  const std::string start = fmt::format(" The reason: WS takes {:.0f}% of its time at {} rays at {} already, ", fixed,
                                        grouped(claimed_many), grouped(claimed_few));
  if (fixed >= 50)
    return start +
           "which is what launching and the longest single rays cost this device, however few there are; "
           "an order can change the rest alone, and its own launches come on top.";
  return start + "so most of the time at the larger count is that of its rays, which an order can change.";
}

}  // namespace

Judge<OrderRow> gains(const Series& series, uint64_t rays, double claimed_gain) {
  return [=](const Rows& rows) -> Judgement {
    const OrderRow* row = find_row(rows, series, rays);
    if (!row) return not_measured();
    Tally tally;
    for (const double gain : {row->gain_unpaid, row->gain_paid})
      tally.add(gain >= claimed_gain, gain >= exceeding * claimed_gain);
    const auto word = [&](double gain) { return gain >= claimed_gain ? "reached" : "not reached"; };
    return {tally.outcome(), paid_and_not(word(row->gain_unpaid), word(row->gain_paid))};
  };
}

Claims<OrderRow> h3dh_gains() {
  const Series h3dh = ordered("hilbert3d-histogram");
  return {{"H3DH takes 23% less time than WS at 1,000 rays", gains(h3dh, claimed_few, 1 / (1 - 0.23))},
          {"H3DH is 2.5 times as fast as WS at 49,000 rays", gains(h3dh, claimed_many, 2.5)}};
}

Judge<OrderRow> fastest_are(std::vector<std::string> best, std::vector<std::string> others) {
  return both_gains([=](const Rows& rows, Gain gain) {
    return std::ranges::all_of(best, [&](const std::string& a) {
      return std::ranges::all_of(
          others, [&](const std::string& b) { return gain_of(rows, a, gain) >= gain_of(rows, b, gain); });
    });
  });
}

Judge<OrderRow> none_slower_than_ws(std::vector<std::string> methods) {
  return both_gains([=](const Rows& rows, Gain gain) {
    const std::set<uint64_t> counts = counts_between(rows, 0, UINT64_MAX);
    return std::ranges::all_of(methods, [&](const std::string& method) {
      return std::ranges::all_of(counts, [&](uint64_t rays) { return gain_at(rows, method, rays, gain) >= 1; });
    });
  });
}

Judge<OrderRow> slightly_slower(const std::string& method, std::vector<std::string> than) {
  return both_gains([=](const Rows& rows, Gain gain) {
    return std::ranges::all_of(than, [&](const std::string& other) {
      const double factor = gain_of(rows, other, gain) / gain_of(rows, method, gain);
      return factor > 1 && factor <= 1.25;
    });
  });
}

Judge<OrderRow> no_slower(const std::string& method, const std::string& than, uint64_t first, uint64_t last) {
  return [=](const Rows& rows) -> Judgement {
    const std::set<uint64_t> counts = counts_between(rows, first, last);
    if (counts.empty()) return not_measured();
    return both_gains([=](const Rows& all, Gain gain) {
      return std::ranges::all_of(counts, [&](uint64_t rays) {
        return gain_at(all, method, rays, gain) * (1 + negligible_gain) >= gain_at(all, than, rays, gain);
      });
    })(rows);
  };
}

Judge<OrderRow> degrades_beyond(const std::string& method, const std::string& against, uint64_t bound) {
  return [=](const Rows& rows) -> Judgement {
    const std::set<uint64_t> below = counts_between(rows, 0, bound),
                             beyond = counts_between(rows, bound + 1, UINT64_MAX);
    if (below.empty() || beyond.empty()) return not_measured();
    return both_gains([=](const Rows& all, Gain gain) {
      const auto speed = [&](uint64_t rays) {
        return gain_at(all, method, rays, gain) / gain_at(all, against, rays, gain);
      };
      return std::ranges::any_of(beyond, [&](uint64_t rays) { return speed(rays) < 0.8 * speed(*below.rbegin()); });
    })(rows);
  };
}

Judge<OrderRow> gain_grows(const std::string& method) {
  return [=](const Rows& rows) -> Judgement {
    if (rows.front().rays == rows.back().rays) return not_measured();
    return both_gains([=](const Rows& all, Gain gain) {
      return gain_of(all, method, gain) > gain_at(all, method, all.front().rays, gain);
    })(rows);
  };
}

Judge<OrderRow> shapes_gain() {
  return [](const Rows& rows) {
    const Series h3dh = ordered("hilbert3d-histogram");
    const auto time = [&](const Series& series) { return find_row(rows, series, rows.back().rays)->times.unpaid_s; };
    double best = 0;
    for (const char* shape : {"2d", "3d"})
      for (const Series& series : {unordered(), h3dh})
        best = std::max(best, time(series) / time(with_shape(series, shape)));
    for (const char* mapped : {"hilbert3d-histogram-hilbert2d", "hilbert3d-histogram-hilbert3d"})
      best = std::max(best, time(h3dh) / time(ordered(mapped)));
    return judgement(best <= 1 + negligible_gain, fmt::format("a factor of {:.2f} at most", best));
  };
}

Fields order_fields(const Rows& rows, const std::string& device) {
  return {{"device", device},
          {"most", grouped(rows.back().rays)},
          {"frames", std::to_string(rows.back().frames)},
          {"reason", reason(rows)}};
}

NumberTable gain_table(const Rows& rows) {
  NumberTable table{.caption = "Speed against WS with the sort not paid, and in brackets with it paid:",
                    .heads = {"order"},
                    .rows = {}};
  std::vector<uint64_t> counts;
  for (const uint64_t rays : std::set{claimed_few, claimed_many, rows.back().rays})
    if (find_row(rows, unordered(), rays)) counts.push_back(rays);
  for (const uint64_t rays : counts) table.heads.push_back(fmt::format("{} rays", grouped(rays)));
  std::vector<OrderRow> ranked;
  for (const OrderRow& row : rows)
    if (row.rays == rows.back().rays) ranked.push_back(row);
  std::ranges::stable_sort(ranked, std::greater{}, &OrderRow::gain_unpaid);
  for (const OrderRow& one : ranked) {
    table.rows.push_back({label(one.series)});
    for (const uint64_t rays : counts) {
      const OrderRow* row = find_row(rows, one.series, rays);
      std::string cell = row ? fmt::format("{:.2f}", row->gain_unpaid) : "not measured";
      if (row && one.series.method != "none") cell += fmt::format(" ({:.2f})", row->gain_paid);
      table.rows.back().push_back(cell);
    }
  }
  return table;
}

}  // namespace wavetracer::study
