// SPDX-License-Identifier: Apache-2.0
// Turns rows into answers and phrases. Factors have two decimals.
// Answers compare times; compare() must have set the gains of the table.
#include "study/order_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <set>
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

using Rows = std::vector<OrderRow>;

constexpr double negligible_gain = 0.05;

// The time of a series, without the order's or with it.
using OrderTime = Measured (*)(const OrderRow&);
Measured unpaid_time(const OrderRow& row) { return {row.times.unpaid_s, row.noise_unpaid * row.times.unpaid_s}; }
Measured paid_time(const OrderRow& row) { return {row.times.paid_s(), row.noise_paid * row.times.paid_s()}; }

// One number of rays, with the sort paid or not.
struct OrderCase {
  const Rows& rows;
  uint64_t count;
  OrderTime time;

  Measured of(const Series& series) const {
    const OrderRow* row = find_row(rows, series, count);
    return row ? time(*row) : Measured{};
  }
  Measured of(const std::string& method) const { return of(ordered(method)); }
  Measured slowest(const std::vector<std::string>& methods) const {
    return std::ranges::max(all(methods), {}, &Measured::value);
  }
  Measured fastest(const std::vector<std::string>& methods) const {
    return std::ranges::min(all(methods), {}, &Measured::value);
  }

 private:
  std::vector<Measured> all(const std::vector<std::string>& methods) const {
    std::vector<Measured> out;
    for (const std::string& method : methods) out.push_back(of(method));
    return out;
  }
};

// The gain of an order over another one: the other's time over its own.
struct OrderGain {
  Answer answer;
  double value;
};

// Answers for each number of rays, with the sort not paid, then with the sort paid.
template <class Holds>
Judge<OrderRow> at_each_count(Holds holds) {
  return [holds](const Rows& rows) {
    Cases out{.form = factor_form()};
    for (const auto& [group, time] : {std::pair{"sort not paid", &unpaid_time}, {"sort paid", &paid_time}})
      for (const uint64_t count : measured_rays(rows)) {
        const OrderGain found = holds(OrderCase{rows, count, time});
        out.all.push_back({group, count, found.answer, found.value});
      }
    return out;
  };
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

Judge<OrderRow> gains(const Series& series, double claimed_gain) {
  return at_each_count([=](const OrderCase& at) -> OrderGain {
    const Measured gain = quotient(at.of(unordered()), at.of(series));
    return {reaches(gain, claimed_gain), gain.value};
  });
}

Claims<OrderRow> h3dh_gains() {
  const Series h3dh = ordered("hilbert3d-histogram");
  return {{"H3DH takes 23% less time than WS at 1,000 rays", gains(h3dh, 1 / (1 - 0.23)), at_rays(claimed_few)},
          {"H3DH is 2.5 times as fast as WS at 49,000 rays", gains(h3dh, 2.5), at_rays(claimed_many)}};
}

Judge<OrderRow> fastest_are(std::vector<std::string> best, std::vector<std::string> others) {
  return at_each_count([=](const OrderCase& at) -> OrderGain {
    const Measured slowest = at.slowest(best), next = at.fastest(others);
    return {less(slowest, next), next.value / slowest.value};
  });
}

Judge<OrderRow> all_faster_than_ws(std::vector<std::string> methods) {
  return at_each_count([=](const OrderCase& at) -> OrderGain {
    const Measured slowest = at.slowest(methods), ws = at.of(unordered());
    return {less(slowest, ws), ws.value / slowest.value};
  });
}

Judge<OrderRow> slightly_slower(const std::string& method, std::vector<std::string> than) {
  return at_each_count([=](const OrderCase& at) -> OrderGain {
    const Measured own = at.of(method), slowest = at.slowest(than), fastest = at.fastest(than);
    return {all_of({less(slowest, own), less(own, 1.25 * fastest)}), slowest.value / own.value};
  });
}

Judge<OrderRow> no_slower(const std::string& method, const std::string& than) {
  return at_each_count([=](const OrderCase& at) -> OrderGain {
    const Measured gain = quotient(at.of(than), at.of(method));
    return {above(gain, 1 / (1 + negligible_gain)), gain.value};
  });
}

Judge<OrderRow> degrades_beyond(const std::string& method, const std::string& against, uint64_t bound) {
  return [=](const Rows& rows) -> Cases {
    uint64_t below_bound = 0;
    Rows beyond_bound;
    for (const OrderRow& row : rows) {
      if (row.rays <= bound) below_bound = std::max(below_bound, row.rays);
      if (row.rays > bound) beyond_bound.push_back(row);
    }
    if (below_bound == 0 || beyond_bound.empty()) return {};
    return at_each_count([&](const OrderCase& at) -> OrderGain {
      const OrderCase before{rows, below_bound, at.time};
      const auto speed = [&](const OrderCase& one) { return quotient(one.of(against), one.of(method)); };
      const Measured kept = quotient(speed(at), speed(before));
      return {below(kept, 0.8), kept.value};
    })(beyond_bound);
  };
}

Judge<OrderRow> gain_grows(const std::string& method) {
  return [=](const Rows& rows) -> Cases {
    const std::vector<uint64_t> counts = measured_rays(rows);
    if (counts.size() < 2) return {};
    Rows most;
    for (const OrderRow& row : rows)
      if (row.rays == counts.back()) most.push_back(row);
    return at_each_count([&](const OrderCase& at) -> OrderGain {
      const auto gain = [&](const OrderCase& one) { return quotient(one.of(unordered()), one.of(method)); };
      const Measured growth = quotient(gain(at), gain({rows, counts.front(), at.time}));
      return {above(growth, 1), growth.value};
    })(most);
  };
}

Judge<OrderRow> shapes_gain_nothing() {
  return [](const Rows& rows) {
    const Series h3dh = ordered("hilbert3d-histogram");
    Cases out{.form = factor_form()};
    for (const uint64_t count : measured_rays(rows)) {
      const OrderCase at{rows, count, unpaid_time};
      std::vector<Measured> gains;
      for (const char* shape : {"2d", "3d"})
        for (const Series& series : {unordered(), h3dh})
          gains.push_back(quotient(at.of(series), at.of(with_shape(series, shape))));
      for (const char* mapped : {"hilbert3d-histogram-hilbert2d", "hilbert3d-histogram-hilbert3d"})
        gains.push_back(quotient(at.of(h3dh), at.of(mapped)));
      const Measured best = std::ranges::max(gains, {}, &Measured::value);
      out.all.push_back({"", count, below(best, 1 + negligible_gain), best.value});
    }
    return out;
  };
}

Claims<OrderRow> over_bins(Claims<OrderRow> claims) {
  for (Claim<OrderRow>& claim : claims)
    claim.judge = [judge = claim.judge](const Rows& rows) {
      std::set<uint32_t> numbers;
      for (const OrderRow& row : rows)
        if (has_bins(row.series)) numbers.insert(row.series.bins);
      Cases out;
      for (const uint32_t bins : numbers) {
        Rows own;
        for (const OrderRow& row : rows)
          if (!has_bins(row.series) || row.series.bins == bins) {
            own.push_back(row);
            own.back().series.bins = thesis_bins;  // by which judges look rows up
          }
        Cases found = judge(own);
        for (CaseAnswer& one : found.all) {
          one.group = fmt::format("{} bins{}{}", bins, one.group.empty() ? "" : ", ", one.group);
          out.all.push_back(one);
        }
        out.form = found.form;
        out.at = found.at;
      }
      return out;
    };
  return claims;
}

Fields order_fields(const Rows& rows, const std::string& device) {
  return {{"device", device},
          {"most", grouped(rows.back().rays)},
          {"frames", std::to_string(rows.back().frames)},
          {"reason", reason(rows)}};
}

NumberTable gain_table(const Rows& rows) {
  NumberTable table{.caption =
                        "Speed against WS, with the sort counted once, as the thesis counts it, and in each frame, "
                        "as a frame pays it:",
                    .heads = {"order"},
                    .rows = {}};
  std::vector<uint64_t> counts;
  for (const uint64_t rays : std::set{claimed_few, claimed_many, rows.back().rays})
    if (find_row(rows, unordered(), rays)) counts.push_back(rays);
  for (const uint64_t rays : counts) {
    table.heads.push_back(fmt::format("{} rays: sort once", grouped(rays)));
    table.heads.emplace_back("in each frame");
  }
  std::vector<OrderRow> ranked;
  for (const OrderRow& row : rows)
    if (row.rays == rows.back().rays) ranked.push_back(row);
  std::ranges::stable_sort(ranked, std::greater{}, &OrderRow::gain_unpaid);
  for (const OrderRow& one : ranked) {
    table.rows.push_back({label(one.series)});
    for (const uint64_t rays : counts) {
      const OrderRow* row = find_row(rows, one.series, rays);
      for (const double OrderRow::*gain : {&OrderRow::gain_unpaid, &OrderRow::gain_paid})
        table.rows.back().push_back(row ? fmt::format("{:.2f}", row->*gain) : "not measured");
    }
  }
  return table;
}

}  // namespace wavetracer::study
