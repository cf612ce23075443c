// SPDX-License-Identifier: Apache-2.0
// Trials of the claims about groups of rays, about orders, and about frames that correlate.
// Names of settings and orders are those of the experiments.
#include "study/claim_trials.hpp"
#include "study/control_equation.hpp"

namespace claim_trials {
namespace {

const std::string own = "groups with own hit points", taken = "groups with one hit point";

// Rows of groups: a quarter less time than no cache, a hundredth of the rays traced, and a small C_E as well as a large
// one, of which the latter loses more.
CacheRows group_rows(const std::string& figure, const CacheChange& change) {
  return rows_of(figure, same, [&](CacheRow& row) {
    if (!row.cache.on) return;
    row.saved_percent = 25;
    row.counts = {.segments = 100000, .lookups = 100000, .hits = 0, .groups = 1000, .shared = 99000};
    row.error.reference_paths = 1000000;
    change(row);
  });
}

// The settings of a study have several C_E at each number of rays: those of one name, in order.
void set_divisions(CacheRows& rows) {
  static constexpr double errors[] = {0.25, 0.5, 1, 2, 4, 10};
  std::map<std::pair<std::string, uint64_t>, size_t> seen;
  for (CacheRow& row : rows) row.division = control_division(row.rays, errors[seen[{row.setting, row.rays}]++ % 6]);
}

// Sets the share of lost paths by the index of its C_E and the number of rays.
CacheRows loss_rows(const std::string& figure, const std::function<double(double error, uint64_t rays)>& lost,
                    uint64_t paths = 1000000) {
  CacheRows rows = group_rows(figure, keep);
  set_divisions(rows);
  for (CacheRow& row : rows) {
    row.error.lost_share = lost(control_error(static_cast<double>(row.rays), row.division), row.rays);
    row.error.reference_paths = paths;
  }
  return rows;
}

void add_innerframe(const std::string& figure, std::vector<Trial<CacheRow>>& out) {
  const auto rows = [figure](const CacheChange& change) { return [=] { return group_rows(figure, change); }; };
  const auto groups = [&](double count) { return rows([count](CacheRow& row) { row.counts.groups = count; }); };
  const auto saved = [&](double percent, double lost) {
    return rows([=](CacheRow& row) {
      row.saved_percent = percent;
      row.error.lost_share = lost;
    });
  };
  out.push_back({figure, "of a group of coherent rays only one is traced", rows(keep), groups(500), groups(1005)});
  out.push_back({figure, "tracing takes less time by coherence inside the frame", saved(25, 0.5), saved(-25, 0.5),
                 saved(0.1, 0.5)});
  out.push_back(
      {figure, "the same, with at most 1% of the paths lost", saved(25, 0.005), saved(25, 0.5), saved(0.1, 0.005)});
  out.push_back({figure, "up to 50 times fewer rays are traced (Popov)", rows(keep),
                 rows([](CacheRow& row) { row.counts.shared = 90000; }),
                 rows([](CacheRow& row) { row.counts.shared = 98000; })});
  out.push_back({figure, "rendering is 2.5 times as fast at least (Popov)", saved(75, 0), saved(50, 0), saved(60, 0)});
  const auto grows = [](double error, uint64_t) { return 0.01 * error; };
  out.push_back({figure, "a larger C_E errs more (Popov)", [=] { return loss_rows(figure, grows); },
                 [=] { return loss_rows(figure, [](double error, uint64_t) { return 0.1 / (1 + error); }); },
                 [=] { return loss_rows(figure, grows, 2); }});
  const auto controlled = [](double, uint64_t) { return 0.02; };
  out.push_back({figure,
                 "C_E controls the error: at equal C_E, lost paths are within a factor of three whatever the number of "
                 "rays (Popov)",
                 [=] { return loss_rows(figure, controlled); },
                 [=] { return loss_rows(figure, [](double, uint64_t rays) { return rays < 50000 ? 0.2 : 0.02; }); },
                 [=] { return loss_rows(figure, controlled, 2); }});
}

// Seconds of orders by name, with the sort not paid; it takes nothing. WS takes 3 s, all others 1 s.
using OrderSeconds = std::function<double(const Series& series, uint64_t rays)>;

Trial<OrderRow> order_trial(const std::string& figure, const std::string& words, const OrderSeconds& yes,
                            const OrderSeconds& no) {
  const auto rows = [figure](const OrderSeconds& seconds, double noise) {
    return [=] {
      const std::vector<uint64_t> counts = {1000, 49000, 100000, 16000000, 50000000, 90000000};
      std::vector<OrderRow> out = made_rows(find_experiment(figure), counts, [&](const Series& series, uint64_t count) {
        return std::pair{seconds(series, count), 0.0};
      });
      for (OrderRow& row : out) row.noise_unpaid = row.noise_paid = noise;
      return out;
    };
  };
  return {figure, words, rows(yes, 0.001), rows(no, 0.001), rows(yes, 3)};
}

OrderSeconds method_takes(const std::string& method, double seconds, uint64_t beyond_rays = 0) {
  return [=](const Series& series, uint64_t rays) {
    if (series.method == "none") return 3.0;
    return series.method == method && rays > beyond_rays ? seconds : 1.0;
  };
}

const std::string h3dh = "hilbert3d-histogram", to_2d = h3dh + "-hilbert2d", to_3d = h3dh + "-hilbert3d";

FramePair frame_pair(uint32_t frame, double correlation) {
  FramePair row;
  row.against = "previous";
  row.frame = frame;
  row.depth = 1;
  row.found.points.total = row.by_place = correlation;
  return row;
}

std::function<std::vector<FramePair>()> correlations(std::vector<double> values) {
  return [=] {
    std::vector<FramePair> rows;
    for (const double value : values) {
      rows.push_back(frame_pair(static_cast<uint32_t>(rows.size()) / 2 + 1, value));
      rows.push_back(rows.back());  // the whole output
      rows.back().depth = 0;
      rows.back().by_place_unordered = value;
    }
    return rows;
  };
}

}  // namespace

std::vector<Trial<CacheRow>> innerframe_trials() {
  std::vector<Trial<CacheRow>> out;
  for (const char* figure : {"innerframe", "innerframe-ordered"}) add_innerframe(figure, out);
  return out;
}

std::vector<Trial<OrderRow>> order_trials() {
  std::vector<Trial<OrderRow>> out;
  const auto one = [&](const char* figure, const char* words, const OrderSeconds& yes, const OrderSeconds& no) {
    out.push_back(order_trial(figure, words, yes, no));
  };
  for (const char* figure : {"figure-6.1", "figure-6.18"}) {
    one(figure, "H3DH takes 23% less time than WS at 1,000 rays", method_takes(h3dh, 1), method_takes(h3dh, 2.8));
    one(figure, "H3DH is 2.5 times as fast as WS at 49,000 rays", method_takes(h3dh, 1), method_takes(h3dh, 2));
  }
  one("figure-6.18", "reordering takes less time at every number of rays", method_takes(h3dh, 1),
      method_takes(h3dh, 4));
  const auto gains = [](double few_s, double many_s) {
    return [=](const Series& series, uint64_t rays) {
      return series.method == "none" ? 3.0 : rays == 1000 ? few_s : many_s;
    };
  };
  one("figure-6.18", "the gain grows with the number of rays", gains(2, 1), gains(1, 2));
  one(
      "figure-6.1", "H3DH and HZ are the fastest of the six orders",
      [](const Series& series, uint64_t) {
        return series.method == h3dh || series.method == "morton-histogram" ? 0.8 : 1.0;
      },
      method_takes("morton", 0.8));
  one("figure-6.1", "WS is the slowest, at every number of rays", method_takes("morton", 2), method_takes("morton", 4));
  one("figure-6.1", "Z is slightly slower than H3DH and HZ, by a quarter at most", method_takes("morton", 1.1),
      method_takes("morton", 1.5));
  one("figure-6.1", "H3DH2DH is not slower than Z up to 50,000,000 rays", method_takes(to_2d, 2, 50000000),
      method_takes(to_2d, 2));
  one("figure-6.1", "H3DH2DH degrades sharply beyond 50,000,000 rays", method_takes(to_2d, 2, 50000000),
      method_takes(to_2d, 2));
  one("figure-6.1", "H3DH3DH is not slower than H3DH2DH up to 16,000,000 rays", method_takes(to_3d, 2, 20000000),
      method_takes(to_3d, 2));
  one("figure-6.1", "launches in two or three dimensions gain nothing over the same order in one",
      method_takes(h3dh, 1), method_takes(to_2d, 0.5));
  return out;
}

std::vector<Trial<FramePair>> frame_trials() {
  std::vector<Trial<FramePair>> out;
  for (const std::string figure : {"figure-6.13", "coherence-frames"}) {
    out.push_back({figure, "subsequent frames correlate by about 25% on average: 20 to 30%",
                   correlations({0.24, 0.26, 0.25}), correlations({0.5, 0.51, 0.52}), correlations({0.0, 0.5, 0.25})});
    out.push_back({figure, "the correlation falls below 5%", correlations({0.02, 0.5}), correlations({0.1, 0.5}),
                   correlations({0.0499, 0.5})});
    out.push_back({figure, "the correlation rises to almost 50%, and no further", correlations({0.1, 0.45}),
                   correlations({0.1, 0.9}), correlations({0.1, 0.4999})});
  }
  return out;
}

}  // namespace claim_trials
