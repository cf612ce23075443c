// SPDX-License-Identifier: Apache-2.0
// Predicates on rows of caches.
// Each looks its rows up by setting, number of rays and world.
#include "study/cache_predicates.hpp"
#include <algorithm>
#include <cmath>

namespace wavetracer::study {
namespace {

constexpr double nothing_saved = 1;  // the time of no cache over itself

// Returns the values of those settings that were measured and have one.
std::vector<Measured> values_there(const CacheRows& rows, const CachePoint& at, CacheValue value,
                                   const std::vector<std::string>& settings) {
  std::vector<Measured> out;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, at.rays, at.drive); row && !std::isnan(value(*row).value))
      out.push_back(value(*row));
  return out;
}

std::vector<std::string> without(std::vector<std::string> settings, const std::vector<std::string>& these) {
  std::erase_if(settings, [&](const std::string& one) { return std::ranges::find(these, one) != these.end(); });
  return settings;
}

// Returns the times of settings over that of no cache; empty if one of them was not measured.
std::vector<Measured> shares_of_none(const CacheRows& rows, const CachePoint& at,
                                     const std::vector<std::string>& settings) {
  std::vector<Measured> out;
  for (const std::string& setting : settings) {
    const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
    if (!row) return {};
    out.push_back(share_of_none(rows, *row));
  }
  return out;
}

}  // namespace

const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at) {
  const CacheRow* best = nullptr;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
        row && (!best || row->warm.loop_s < best->warm.loop_s))
      best = row;
  return best;
}

Measured share_of_none(const CacheRows& rows, const CacheRow& row) {
  const CacheRow* none = find_cached(rows, rows.front().setting, row.rays, row.drive);
  if (!none) return {};
  // A setting is compared with no cache as it was measured beside it, which saved_percent keeps.
  const double share = 1 - row.saved_percent / 100;
  return {share, share * quotient(warm_s(row), warm_s(*none)).error / (row.warm.loop_s / none->warm.loop_s)};
}

Measured warm_s(const CacheRow& row) { return {row.warm.loop_s, row.warm_error.loop_s}; }
Measured once_s(const CacheRow& row) { return {warm_once_s(row), row.warm_error.loop_s}; }
Measured l2_m(const CacheRow& row) { return {row.error.l2_m, row.l2_error_m}; }
Measured l2_relative(const CacheRow& row) {
  const double scale = row.error.l2_m > 0 ? row.error.l2_relative / row.error.l2_m : 0;
  return {row.error.l2_relative, scale * row.l2_error_m};
}

AtPoint saves(std::vector<std::string> settings) {
  return {[settings = std::move(settings)](const CacheRows& rows, const CachePoint& at) -> Answered {
    const CacheRow* best = fastest(rows, settings, at);
    if (!best) return {};
    const Measured share = share_of_none(rows, *best);
    return {below(share, nothing_saved), share.value};
  }};
}

AtPoint saves_not(std::vector<std::string> settings) {
  return {[saved = saves(std::move(settings)).at](const CacheRows& rows, const CachePoint& at) -> Answered {
    const Answered found = saved(rows, at);
    return {opposite(found.answer), found.value};
  }};
}

AtPoint saves_percent(const std::string& setting, double claimed) {
  return {[=](const CacheRows& rows, const CachePoint& at) -> Answered {
    const std::vector<Measured> share = shares_of_none(rows, at, {setting});
    if (share.empty()) return {};
    const auto saved = [&](double percent) { return below(share[0], 1 - percent / 100); };
    const bool more = saved(exceeding * claimed) == Answer::yes;
    return {more ? Answer::beyond : saved(claimed), share[0].value};
  }};
}

AtPoint all_save(std::vector<std::string> settings) {
  return {[settings = std::move(settings)](const CacheRows& rows, const CachePoint& at) -> Answered {
    const std::vector<Measured> shares = shares_of_none(rows, at, settings);
    if (shares.empty()) return {};
    std::vector<Answer> answers;
    for (const Measured& share : shares) answers.push_back(below(share, nothing_saved));
    return {all_of(answers), std::ranges::max(shares, {}, &Measured::value).value};
  }};
}

AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent) {
  return {[=](const CacheRows& rows, const CachePoint& at) -> Answered {
    const std::vector<Measured> shares = shares_of_none(rows, at, settings);
    if (shares.empty()) return {};
    std::vector<Answer> answers;
    for (const Measured& share : shares) answers.push_back(between(share, 1 - percent / 100, 1 + percent / 100));
    const auto distance = [](const Measured& share) { return std::abs(share.value - nothing_saved); };
    return {all_of(answers), std::ranges::max(shares, {}, distance).value};
  }};
}

AtPoint fastest_is(const std::string& setting, const std::vector<std::string>& settings) {
  return {[setting, others = without(settings, {setting})](const CacheRows& rows, const CachePoint& at) -> Answered {
            const std::vector<Measured> own = values_there(rows, at, warm_s, {setting}),
                                        all = values_there(rows, at, warm_s, others);
            if (own.empty() || all.empty()) return {};
            const Measured next = std::ranges::min(all, {}, &Measured::value);
            return {less(own[0], next), own[0].value / next.value};
          },
          ratio_form(setting, "the next")};
}

AtPoint slowest_is(const std::string& setting, const std::vector<std::string>& settings) {
  return largest_are(warm_s, {setting}, settings);
}

AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others) {
  return {[=, rest = without(others, largest)](const CacheRows& rows, const CachePoint& at) -> Answered {
            const std::vector<Measured> first = values_there(rows, at, value, largest),
                                        all = values_there(rows, at, value, rest);
            if (first.size() < largest.size() || all.empty()) return {};
            const Measured least = std::ranges::min(first, {}, &Measured::value),
                           next = std::ranges::max(all, {}, &Measured::value);
            if (least.value == 0) return {Answer::no, undefined, "it is 0"};
            return {less(next, least), next.value > 0 ? least.value / next.value : undefined};
          },
          ratio_form("the least of these", "the next")};
}

AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor) {
  return {[=](const CacheRows& rows, const CachePoint& at) -> Answered {
            const std::vector<Measured> a = values_there(rows, at, value, {setting}),
                                        b = values_there(rows, at, value, {than});
            if (a.empty() || b.empty()) return {};
            if (a[0].value == 0 && b[0].value == 0) return {Answer::no, undefined, "both are 0"};
            return {less(factor * a[0], b[0]), b[0].value > 0 ? a[0].value / b[0].value : undefined};
          },
          ratio_form(setting, than)};
}

AtPoint at_most(CacheValue value, const std::string& setting, double bound, const ValueForm& form) {
  return {[=](const CacheRows& rows, const CachePoint& at) -> Answered {
            const std::vector<Measured> found = values_there(rows, at, value, {setting});
            if (found.empty()) return {};
            return {between(found[0], -INFINITY, bound), found[0].value};
          },
          form};
}

}  // namespace wavetracer::study
