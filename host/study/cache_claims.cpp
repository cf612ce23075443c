// SPDX-License-Identifier: Apache-2.0
// Turns rows into verdicts.
// A row that was not measured confirms nothing.
#include "study/cache_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/ray_counts.hpp"
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

// Averages over the numbers of rays at which all of these settings have the value; empty if there is no such number.
std::vector<RunningMean> means_of(const CacheRows& rows, const std::string& drive, CacheValue value,
                                  const std::vector<std::string>& settings) {
  std::vector<RunningMean> means(settings.size());
  for (const uint64_t rays : rays_of(rows)) {
    std::vector<double> values;
    for (const std::string& setting : settings)
      if (const CacheRow* row = find_cached(rows, setting, rays, drive); row && std::isfinite(value(*row)))
        values.push_back(value(*row));
    if (values.size() < settings.size()) continue;
    for (size_t i = 0; i < means.size(); ++i) means[i].add(values[i]);
  }
  return means;
}

// Returns "fixed transmitter: TEXT; moving transmitter: TEXT".
template <class OfDrive>
Judgement of_each_drive(const CacheRows& rows, const OfDrive& of_drive) {
  std::string text;
  Tally tally;
  for (const std::string& drive : drives_of(rows)) {
    const Judgement found = of_drive(drive);
    tally.add(found.outcome);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", drive_words(drive), found.words);
  }
  return {tally.outcome(), text};
}

// Returns "confirmed, WHAT".
Judgement measured(bool holds, const std::string& what) { return judgement(holds, verdict(holds) + ", " + what); }

CachePoint first_point(const CacheRows& rows) { return {rows.front().drive, rows.front().rays}; }

}  // namespace

Judge<CacheRow> everywhere(AtRays within, AtPoint holds) {
  return [=](const CacheRows& rows) -> Judgement {
    std::vector<uint64_t> rays = rays_of(rows);
    std::erase_if(rays, std::not_fn(within));
    if (rays.empty()) return not_measured();
    return judgement(std::ranges::all_of(rays, [&](uint64_t n) { return holds(rows, {rows.front().drive, n}); }));
  };
}

Judge<CacheRow> where(AtPoint holds, CacheValue defined) {
  return [=](const CacheRows& rows) {
    const auto of_drive = [&](const std::string& drive) -> Judgement {
      std::vector<uint64_t> rays = rays_of(rows);
      std::erase_if(rays, [&](uint64_t n) {
        const CacheRow* row = find_cached(rows, rows.front().setting, n, drive);
        return defined && (!row || std::isnan(defined(*row)));
      });
      if (rays.empty()) return {ClaimOutcome::not_judged, "no path has a vertex"};
      return where_judged(rays, [&](uint64_t n) { return holds(rows, {drive, n}); });
    };
    return of_each_drive(rows, of_drive);
  };
}

Judge<CacheRow> where_saved(const std::string& setting, double percent) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) {
      const auto saves_at_least = [&](double bound) -> AtRays {
        return [&rows, &drive, holds = saves_percent(setting, bound)](uint64_t n) { return holds(rows, {drive, n}); };
      };
      return where_judged(rays_of(rows), saves_at_least(percent), saves_at_least(exceeding * percent));
    });
  };
}

Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> Judgement {
      const std::vector<RunningMean> means = means_of(rows, drive, value, {setting, than});
      const double a = means[0].mean(), b = means[1].mean();
      if (std::isnan(a)) return not_measured();
      if (a == 0 && b == 0) return {ClaimOutcome::not_judged, "both are 0"};
      if (b == 0) return judgement(false, "not confirmed, the other is 0");
      return measured(a / b >= low && a / b <= high, fmt::format("a factor of {}", plain(a / b)));
    });
  };
}

Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> Judgement {
      const double mean = means_of(rows, drive, value, {setting})[0].mean();
      if (std::isnan(mean)) return not_measured();
      return measured(mean >= low && mean <= high, fmt::format("{} {}", plain(mean), unit));
    });
  };
}

Judge<CacheRow> at_first(CacheValue value, const std::string& setting, double low, double high,
                         const std::string& unit) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> Judgement {
      const CacheRow* row = find_cached(rows, setting, rays_of(rows).front(), drive);
      if (!row || std::isnan(value(*row))) return not_measured();
      const double found = value(*row);
      return measured(found >= low && found <= high, fmt::format("{} {}", plain(found), unit));
    });
  };
}

Judge<CacheRow> saving_grows(const std::string& setting) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> Judgement {
      const std::vector<uint64_t> rays = rays_of(rows);
      const CacheRow *few = find_cached(rows, setting, rays.front(), drive),
                     *many = find_cached(rows, setting, rays.back(), drive);
      if (!few || !many || few == many) return not_measured();
      return measured(many->saved_percent > few->saved_percent,
                      fmt::format("{} at {} rays and {} at {}", saved_words(few->saved_percent), grouped(rays.front()),
                                  saved_words(many->saved_percent), grouped(rays.back())));
    });
  };
}

Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays) {
  return [=](const CacheRows& rows) -> Judgement {
    const std::string& drive = rows.front().drive;
    const auto saved_s = [&](uint64_t count) {
      const CacheRow *best = fastest(rows, settings, {drive, count}),
                     *none = find_cached(rows, rows.front().setting, count, drive);
      return best && none ? warm_s(*none) - warm_s(*best) : undefined;
    };
    const double here_s = saved_s(rays);
    if (std::isnan(here_s)) return not_measured();
    const std::vector<uint64_t> all = rays_of(rows);
    return judgement(here_s > 0 && std::ranges::none_of(all, [&](uint64_t count) { return saved_s(count) > here_s; }));
  };
}

Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than) {
  return [=](const CacheRows& rows) -> Judgement {
    const std::string& drive = rows.front().drive;
    const std::vector<uint64_t> all = rays_of(rows);
    if (!find_cached(rows, setting, all.front(), drive) || !find_cached(rows, than, all.front(), drive))
      return not_measured();
    const auto from = [&](const std::string& one) {
      return std::ranges::find_if(all, [&](uint64_t rays) { return saves({one})(rows, {drive, rays}); });
    };
    const auto words = [&](const auto& at) {
      return at == all.end() ? "nowhere" : "from " + grouped(*at) + " rays on";
    };
    return measured(from(setting) < from(than),
                    fmt::format("{}; the other {}", words(from(setting)), words(from(than))));
  };
}

Judge<CacheRow> not_judged(const std::string& why) {
  return [=](const CacheRows&) { return Judgement{ClaimOutcome::not_judged, why}; };
}

Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<std::optional<bool>(const CacheRow&)> holds) {
  return [=](const CacheRows& rows) -> Judgement {
    const auto [drive, rays] = first_point(rows);
    std::vector<std::string> yes, no;
    for (const std::string& setting : settings)
      if (const CacheRow* row = find_cached(rows, setting, rays, drive))
        if (const std::optional<bool> found = holds(*row)) (*found ? yes : no).push_back('"' + setting + '"');
    if (yes.empty() && no.empty()) return not_measured();
    if (no.empty()) return judgement(true, "confirmed for all");
    if (yes.empty()) return judgement(false, "not confirmed for any");
    return {ClaimOutcome::in_part, fmt::format("confirmed for {}, not for {}", list_words(yes), list_words(no))};
  };
}

Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than) {
  return
      [holds = less(value, setting, than)](const CacheRows& rows) { return judgement(holds(rows, first_point(rows))); };
}

std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds) {
  std::vector<std::string> found;
  for (const uint64_t count : rays)
    if (holds(count)) found.push_back(grouped(count));
  if (found.empty()) return "at none of the numbers of rays";
  if (found.size() == rays.size() && rays.size() > 1) return "at every number of rays";
  return "at " + list_words(found) + " rays";
}

Judgement where_judged(const std::vector<uint64_t>& rays, const AtRays& holds, const AtRays& goes_beyond) {
  Tally tally;
  for (const uint64_t count : rays) tally.add(holds(count), goes_beyond && goes_beyond(count));
  return {tally.outcome(), where_words(rays, holds)};
}

std::string drive_words(const std::string& drive) {
  if (drive == "spheres") return "fixed transmitter, reception by spheres";
  if (drive == "thesis") return "moving transmitters, reception by spheres";
  if (drive == "moving") return "moving transmitters";
  return drive == "fixed" ? "fixed transmitter" : drive + " world";
}

Fields cache_fields(const CacheRows& rows, const std::string& device, const std::vector<std::string>& settings) {
  const auto one_saves = [&, any = saves(settings)](uint64_t n) { return any(rows, {rows.front().drive, n}); };
  return {{"device", device}, {"rays", grouped(rows.front().rays)}, {"saves", where_words(rays_of(rows), one_saves)}};
}

}  // namespace wavetracer::study
