// SPDX-License-Identifier: Apache-2.0
// Turns rows into verdicts.
// A row that was not measured confirms nothing.
#include "study/innerframe_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include "study/cache_claims.hpp"
#include "study/control_equation.hpp"

namespace wavetracer::study {
namespace {

using RowList = std::vector<const CacheRow*>;

RowList rows_of_settings(const CacheRows& rows, const std::vector<std::string>& settings) {
  RowList out;
  for (const CacheRow& row : rows)
    if (std::ranges::find(settings, row.setting) != settings.end()) out.push_back(&row);
  return out;
}

double error_of(const CacheRow& row) { return control_error(static_cast<double>(row.rays), row.division); }

// Returns rows of one world, setting and number of rays, by ascending C_E.
std::vector<RowList> ladders(const CacheRows& rows, const std::vector<std::string>& settings) {
  std::map<std::tuple<std::string, std::string, uint64_t>, RowList> found;
  for (const CacheRow* row : rows_of_settings(rows, settings))
    found[{row->drive, row->setting, row->rays}].push_back(row);
  std::vector<RowList> out;
  for (auto& [key, ladder] : found) {
    std::ranges::sort(ladder, {}, [](const CacheRow* row) { return error_of(*row); });
    out.push_back(std::move(ladder));
  }
  return out;
}

Judgement most(double value, double claimed) {
  if (std::isnan(value)) return not_measured();
  Tally tally;
  tally.add(value >= claimed, value >= exceeding * claimed);
  return {tally.outcome(), value >= claimed ? fmt::format("confirmed: up to {} times", plain(value))
                                            : fmt::format("not confirmed: {} times at most", plain(value))};
}

template <class Value>
double largest(const CacheRows& rows, Value value) {
  double out = undefined;
  for (const CacheRow& row : rows)
    if (row.counts.groups > 0) out = std::isnan(out) ? value(row) : std::max(out, value(row));
  return out;
}

}  // namespace

Judge<CacheRow> one_ray_a_group(std::vector<std::string> settings) {
  return [=](const CacheRows& rows) -> Judgement {
    const RowList found = rows_of_settings(rows, settings);
    if (found.empty()) return not_measured();
    return judgement(std::ranges::all_of(found, [](const CacheRow* row) {
      return row->counts.groups > 0 && std::abs(row->counts.traced() - row->counts.groups) < 0.5;
    }));
  };
}

Judge<CacheRow> somewhere_faster(std::vector<std::string> settings, double lost_share) {
  return [=](const CacheRows& rows) -> Judgement {
    const RowList found = rows_of_settings(rows, settings);
    if (found.empty()) return not_measured();
    return where_judged(rays_of(rows), [&](uint64_t rays) {
      return std::ranges::any_of(found, [&](const CacheRow* row) {
        return row->rays == rays && row->saved_percent >= 0.5 && row->error.lost_share <= lost_share;
      });
    });
  };
}

Judge<CacheRow> fewer_traced_times(double claimed) {
  return [=](const CacheRows& rows) {
    return most(largest(rows, [](const CacheRow& row) { return row.counts.segments / row.counts.traced(); }), claimed);
  };
}

Judge<CacheRow> times_as_fast(double claimed) {
  return [=](const CacheRows& rows) {
    return most(largest(rows, [](const CacheRow& row) { return 1 / (1 - row.saved_percent / 100); }), claimed);
  };
}

Judge<CacheRow> error_grows(std::vector<std::string> settings) {
  return [=](const CacheRows& rows) -> Judgement {
    const std::vector<RowList> all = ladders(rows, settings);
    const bool measured = std::ranges::any_of(all, [](const RowList& ladder) { return ladder.size() > 1; });
    if (!measured) return not_measured();
    return judgement(std::ranges::all_of(all, [](const RowList& ladder) {
      return ladder.size() < 2 || ladder.back()->error.lost_share > ladder.front()->error.lost_share;
    }));
  };
}

Judge<CacheRow> error_is_controlled(std::vector<std::string> settings, double factor, double negligible) {
  return [=](const CacheRows& rows) -> Judgement {
    // Keys are world, setting and index in the ladder, which stands for one C_E; values are the shares at all numbers
    // of rays.
    std::map<std::tuple<std::string, std::string, size_t>, std::vector<double>> shares;
    for (const RowList& ladder : ladders(rows, settings))
      for (size_t step = 0; step < ladder.size(); ++step)
        shares[{ladder[step]->drive, ladder[step]->setting, step}].push_back(ladder[step]->error.lost_share);
    bool measured = false, all = true;
    for (const auto& [key, values] : shares) {
      if (values.size() < 2) continue;
      measured = true;
      const auto [low, high] = std::ranges::minmax(values);
      all = all && (high < negligible || high <= factor * low);
    }
    return measured ? judgement(all) : not_measured();
  };
}

}  // namespace wavetracer::study
