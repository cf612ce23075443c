// Rows to verdicts.
// A row that was not measured confirms nothing.
#include "study/cache_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/ray_counts.hpp"
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

// Null for none.
const CacheRow* fastest(const CacheRows& rows, const std::vector<std::string>& settings, const CachePoint& at) {
  const CacheRow* best = nullptr;
  for (const std::string& setting : settings)
    if (const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
        row && (!best || warm_s(*row) < warm_s(*best)))
      best = row;
  return best;
}

// Over the numbers of rays at which all of these settings have it; none where there is no such number.
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

// "fixed transmitter: TEXT; moving transmitter: TEXT"
template <class OfDrive>
std::string of_each_drive(const CacheRows& rows, const OfDrive& of_drive) {
  std::string text;
  for (const std::string& drive : drives_of(rows))
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", drive_words(drive), of_drive(drive));
  return text;
}

CachePoint first_point(const CacheRows& rows) { return {rows.front().drive, rows.front().rays}; }

}  // namespace

double warm_s(const CacheRow& row) { return row.warm.loop_s; }
double l2_m(const CacheRow& row) { return row.error.l2_m; }
double l2_relative(const CacheRow& row) { return row.error.l2_relative; }

AtPoint saves(std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* best = fastest(rows, settings, at);
    return best && best->saved_percent >= 0.5;
  };
}

AtPoint saves_not(std::vector<std::string> settings) { return std::not_fn(saves(std::move(settings))); }

AtPoint saves_percent(const std::string& setting, double claimed) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
    return row && row->saved_percent >= claimed;
  };
}

AtPoint all_save(std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    return std::ranges::all_of(settings, [&](const std::string& setting) { return saves({setting})(rows, at); });
  };
}

AtPoint all_take_the_time_of_none(std::vector<std::string> settings, double percent) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    return std::ranges::all_of(settings, [&](const std::string& setting) {
      const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
      return row && std::abs(row->saved_percent) <= percent;
    });
  };
}

AtPoint slowest_is(const std::string& setting, std::vector<std::string> settings) {
  return largest_are(warm_s, {setting}, std::move(settings));
}

AtPoint largest_are(CacheValue value, std::vector<std::string> largest, std::vector<std::string> others) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const auto value_of_one = [&](const std::string& setting) {
      const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
      return row ? value(*row) : undefined;
    };
    return std::ranges::all_of(largest, [&](const std::string& a) {
      return value_of_one(a) > 0 && std::ranges::all_of(others, [&](const std::string& b) {
               return std::ranges::find(largest, b) != largest.end() || value_of_one(a) >= value_of_one(b);
             });
    });
  };
}

AtPoint fastest_is(const std::string& setting, std::vector<std::string> settings) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* best = fastest(rows, settings, at);
    return best && best->setting == setting;
  };
}

AtPoint less(CacheValue value, const std::string& setting, const std::string& than, double factor) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow *a = find_cached(rows, setting, at.rays, at.drive), *b = find_cached(rows, than, at.rays, at.drive);
    return a && b && factor * value(*a) < value(*b);
  };
}

AtPoint at_most(CacheValue value, const std::string& setting, double bound) {
  return [=](const CacheRows& rows, const CachePoint& at) {
    const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
    return row && value(*row) <= bound;
  };
}

AtRays above(uint64_t bound) {
  return [=](uint64_t rays) { return rays > bound; };
}
AtRays up_to(uint64_t bound) { return std::not_fn(above(bound)); }
AtRays between(uint64_t first, uint64_t last) {
  return [=](uint64_t rays) { return rays >= first && rays <= last; };
}
AtRays outside(uint64_t first, uint64_t last) { return std::not_fn(between(first, last)); }

Judge<CacheRow> everywhere(AtRays within, AtPoint holds) {
  return [=](const CacheRows& rows) -> std::string {
    std::vector<uint64_t> rays = rays_of(rows);
    std::erase_if(rays, std::not_fn(within));
    if (rays.empty()) return "not measured";
    return verdict(std::ranges::all_of(rays, [&](uint64_t n) { return holds(rows, {rows.front().drive, n}); }));
  };
}

Judge<CacheRow> where(AtPoint holds, CacheValue defined) {
  return [=](const CacheRows& rows) {
    const auto of_drive = [&](const std::string& drive) -> std::string {
      std::vector<uint64_t> rays = rays_of(rows);
      std::erase_if(rays, [&](uint64_t n) {
        const CacheRow* row = find_cached(rows, rows.front().setting, n, drive);
        return defined && (!row || std::isnan(defined(*row)));
      });
      if (rays.empty()) return "no path has a vertex";
      return where_words(rays, [&](uint64_t n) { return holds(rows, {drive, n}); });
    };
    return of_each_drive(rows, of_drive);
  };
}

Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> std::string {
      const std::vector<RunningMean> means = means_of(rows, drive, value, {setting, than});
      const double a = means[0].mean(), b = means[1].mean();
      if (std::isnan(a)) return "not measured";
      if (b == 0) return a == 0 ? "both are 0" : "not confirmed, the other is 0";
      return fmt::format("{}, a factor of {}", verdict(a / b >= low && a / b <= high), plain(a / b));
    });
  };
}

Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> std::string {
      const double mean = means_of(rows, drive, value, {setting})[0].mean();
      if (std::isnan(mean)) return "not measured";
      return fmt::format("{}, {} {}", verdict(mean >= low && mean <= high), plain(mean), unit);
    });
  };
}

Judge<CacheRow> at_first(CacheValue value, const std::string& setting, double low, double high,
                         const std::string& unit) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> std::string {
      const CacheRow* row = find_cached(rows, setting, rays_of(rows).front(), drive);
      if (!row || std::isnan(value(*row))) return "not measured";
      return fmt::format("{}, {} {}", verdict(value(*row) >= low && value(*row) <= high), plain(value(*row)), unit);
    });
  };
}

Judge<CacheRow> saving_grows(const std::string& setting) {
  return [=](const CacheRows& rows) {
    return of_each_drive(rows, [&](const std::string& drive) -> std::string {
      const std::vector<uint64_t> rays = rays_of(rows);
      const CacheRow *few = find_cached(rows, setting, rays.front(), drive),
                     *many = find_cached(rows, setting, rays.back(), drive);
      if (!few || !many || few == many) return "not measured";
      return fmt::format("{}, {} at {} rays and {} at {}", verdict(many->saved_percent > few->saved_percent),
                         saved_words(few->saved_percent), grouped(rays.front()), saved_words(many->saved_percent),
                         grouped(rays.back()));
    });
  };
}

Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays) {
  return [=](const CacheRows& rows) -> std::string {
    const std::string& drive = rows.front().drive;
    const auto saved_s = [&](uint64_t count) {
      const CacheRow *best = fastest(rows, settings, {drive, count}),
                     *none = find_cached(rows, rows.front().setting, count, drive);
      return best && none ? warm_s(*none) - warm_s(*best) : undefined;
    };
    const double here_s = saved_s(rays);
    if (std::isnan(here_s)) return "not measured";
    const std::vector<uint64_t> all = rays_of(rows);
    return verdict(here_s > 0 && std::ranges::none_of(all, [&](uint64_t count) { return saved_s(count) > here_s; }));
  };
}

Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than) {
  return [=](const CacheRows& rows) -> std::string {
    const std::string& drive = rows.front().drive;
    const std::vector<uint64_t> all = rays_of(rows);
    if (!find_cached(rows, setting, all.front(), drive) || !find_cached(rows, than, all.front(), drive))
      return "not measured";
    const auto from = [&](const std::string& one) {
      return std::ranges::find_if(all, [&](uint64_t rays) { return saves({one})(rows, {drive, rays}); });
    };
    const auto words = [&](const auto& at) {
      return at == all.end() ? "nowhere" : "from " + grouped(*at) + " rays on";
    };
    return fmt::format("{}, {}; the other {}", verdict(from(setting) < from(than)), words(from(setting)),
                       words(from(than)));
  };
}

Judge<CacheRow> not_judged(const std::string& why) {
  return [=](const CacheRows&) { return "not judged: " + why; };
}

Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<bool(const CacheRow&)> holds) {
  return [=](const CacheRows& rows) -> std::string {
    const auto [drive, rays] = first_point(rows);
    std::vector<std::string> yes, no;
    for (const std::string& setting : settings)
      if (const CacheRow* row = find_cached(rows, setting, rays, drive))
        (holds(*row) ? yes : no).push_back('"' + setting + '"');
    if (no.empty()) return yes.empty() ? "not measured" : "confirmed for all";
    return yes.empty() ? "not confirmed for any"
                       : fmt::format("confirmed for {}, not for {}", list_words(yes), list_words(no));
  };
}

Judge<CacheRow> of_all(std::vector<std::string> settings, std::function<bool(const CacheRow&)> holds) {
  return [=](const CacheRows& rows) -> std::string {
    const auto [drive, rays] = first_point(rows);
    bool measured = false, all = true;
    for (const std::string& setting : settings)
      if (const CacheRow* row = find_cached(rows, setting, rays, drive)) {
        measured = true;
        all = all && holds(*row);
      }
    return measured ? verdict(all) : "not measured";
  };
}

Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than) {
  return
      [holds = less(value, setting, than)](const CacheRows& rows) { return verdict(holds(rows, first_point(rows))); };
}

std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds) {
  std::vector<std::string> found;
  for (const uint64_t count : rays)
    if (holds(count)) found.push_back(grouped(count));
  if (found.empty()) return "at none of the numbers of rays";
  if (found.size() == rays.size() && rays.size() > 1) return "at every number of rays";
  return "at " + list_words(found) + " rays";
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
