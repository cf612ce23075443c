// SPDX-License-Identifier: Apache-2.0
// Turns rows into answers.
// A row that was not measured answers nothing.
#include "study/cache_claims.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/ray_counts.hpp"
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

// Returns means over the numbers of rays at which all of these settings have the value, in the order of the settings;
// none if there is no such number.
std::vector<Measured> means_of(const CacheRows& rows, const std::string& drive, CacheValue value,
                               const std::vector<std::string>& settings) {
  std::vector<Measured> sums(settings.size(), Measured{0, 0});
  double count = 0;
  for (const uint64_t rays : rays_of(rows)) {
    std::vector<Measured> values;
    for (const std::string& setting : settings)
      if (const CacheRow* row = find_cached(rows, setting, rays, drive); row && std::isfinite(value(*row).value))
        values.push_back(value(*row));
    if (values.size() < settings.size()) continue;
    ++count;
    for (size_t i = 0; i < sums.size(); ++i) {
      sums[i].value += values[i].value;
      sums[i].error = std::hypot(sums[i].error, values[i].error);
    }
  }
  if (count == 0) return {};
  for (Measured& sum : sums) sum = 1 / count * sum;
  return sums;
}

// Returns the words for a world, which are empty if a study has no other than the built-in one without motion.
std::string world_of(const CacheRows& rows, const std::string& drive) {
  return drives_of(rows).size() == 1 && drive == "still" ? "" : drive_words(drive);
}

// Answers for each world.
template <class OfDrive>
Judge<CacheRow> in_each_world(const ValueForm& form, OfDrive of_drive) {
  return [=](const CacheRows& rows) {
    Cases out{.form = form};
    for (const std::string& drive : drives_of(rows)) {
      const Answered found = of_drive(rows, drive);
      out.all.push_back({world_of(rows, drive), 0, found.answer, found.value, found.note});
    }
    return out;
  };
}

}  // namespace

Judge<CacheRow> where(AtPoint holds) {
  return [holds = std::move(holds)](const CacheRows& rows) {
    Cases out{.form = holds.form};
    for (const std::string& drive : drives_of(rows))
      for (const uint64_t rays : rays_of(rows)) {
        const Answered found = holds.at(rows, {drive, rays});
        out.all.push_back({world_of(rows, drive), rays, found.answer, found.value, found.note});
      }
    return out;
  };
}

Judge<CacheRow> where_saved(const std::string& setting, double percent) {
  return where(saves_percent(setting, percent));
}

Judge<CacheRow> of_each(std::vector<std::string> settings, std::function<Answered(const CacheRow&)> holds,
                        const ValueForm& form) {
  return [=](const CacheRows& rows) {
    Cases out{.form = form};
    for (const std::string& setting : settings) {
      const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive);
      if (!row) continue;
      const Answered found = holds(*row);
      out.all.push_back({'"' + setting + '"', 0, found.answer, found.value, found.note});
    }
    return out;
  };
}

Judge<CacheRow> on_average(CacheValue value, const std::string& setting, const std::string& than, double low,
                           double high) {
  return in_each_world(ratio_form(setting, than), [=](const CacheRows& rows, const std::string& drive) -> Answered {
    const std::vector<Measured> means = means_of(rows, drive, value, {setting, than});
    if (means.empty()) return {};
    if (means[1].value == 0 && means[0].value == 0) return {Answer::undecided, undefined, "both are 0"};
    if (means[1].value == 0) return {Answer::no, undefined, "the other is 0"};
    const Measured factor = quotient(means[0], means[1]);
    return {between(factor, low, high), factor.value};
  });
}

Judge<CacheRow> mean_between(CacheValue value, const std::string& setting, double low, double high,
                             const std::string& unit) {
  return in_each_world(unit_form(unit), [=](const CacheRows& rows, const std::string& drive) -> Answered {
    const std::vector<Measured> means = means_of(rows, drive, value, {setting});
    if (means.empty()) return {};
    return {between(means[0], low, high), means[0].value};
  });
}

Judge<CacheRow> value_between(CacheValue value, const std::string& setting, double low, double high,
                              const std::string& unit) {
  return where({[=](const CacheRows& rows, const CachePoint& at) -> Answered {
                  const CacheRow* row = find_cached(rows, setting, at.rays, at.drive);
                  if (!row) return {};
                  return {between(value(*row), low, high), value(*row).value};
                },
                unit_form(unit)});
}

Judge<CacheRow> saving_grows(const std::string& setting) {
  return in_each_world({}, [=](const CacheRows& rows, const std::string& drive) -> Answered {
    const std::vector<uint64_t> rays = rays_of(rows);
    const CacheRow *few = find_cached(rows, setting, rays.front(), drive),
                   *many = find_cached(rows, setting, rays.back(), drive);
    if (!few || !many || few == many) return {};
    const Measured at_few = share_of_none(rows, *few), at_many = share_of_none(rows, *many);
    const auto words = [](const Measured& share) { return saved_words(100 * (1 - share.value)); };
    return {less(at_many, at_few), undefined,
            fmt::format("{} at {} rays and {} at {}", words(at_few), grouped(rays.front()), words(at_many),
                        grouped(rays.back()))};
  });
}

Judge<CacheRow> saves_most_at(std::vector<std::string> settings, uint64_t rays) {
  return in_each_world({}, [=](const CacheRows& rows, const std::string& drive) -> Answered {
    const auto saved_s = [&](uint64_t count) -> Measured {
      const CacheRow *best = fastest(rows, settings, {drive, count}),
                     *none = find_cached(rows, rows.front().setting, count, drive);
      if (!best || !none) return {};
      const Measured with = warm_s(*best), without = warm_s(*none);
      // The difference keeps the noise of both times, as margins are relative to a value.
      return {without.value - with.value, std::hypot(margin(with), margin(without)) / noise_factor};
    };
    const Measured here = saved_s(rays);
    std::vector<Answer> answers = {above(here, 0)};
    for (const uint64_t count : rays_of(rows))
      if (count != rays) answers.push_back(less(saved_s(count), here));
    return {all_of(answers), undefined,
            std::isnan(here.value) ? "" : fmt::format("{} ms are saved there", plain(1e3 * here.value))};
  });
}

Judge<CacheRow> gains_earlier(const std::string& setting, const std::string& than) {
  return in_each_world({}, [=](const CacheRows& rows, const std::string& drive) -> Answered {
    const std::vector<uint64_t> all = rays_of(rows);
    if (!find_cached(rows, setting, all.front(), drive) || !find_cached(rows, than, all.front(), drive)) return {};
    // The first number of rays at which a setting saves time, or may save some, as far as the noise tells.
    const auto from = [&](const std::string& one, bool surely) {
      const AtPoint saved = saves({one});
      return std::ranges::find_if(all, [&](uint64_t rays) {
        const Answer answer = saved.at(rows, {drive, rays}).answer;
        return answer == Answer::yes || (!surely && answer == Answer::undecided);
      });
    };
    const auto words = [&](const auto& at) {
      return at == all.end() ? "nowhere" : "from " + grouped(*at) + " rays on";
    };
    const auto one = from(setting, true), other = from(than, true);
    Answer answer = Answer::undecided;
    if (one < from(than, false)) answer = Answer::yes;
    if (other != all.end() && other <= from(setting, false)) answer = Answer::no;
    return {answer, undefined, words(one) + ", the other " + words(other)};
  });
}

Judge<CacheRow> not_judged(const std::string& why) {
  return [=](const CacheRows&) { return Cases{.why = why}; };
}

Judge<CacheRow> is_less(CacheValue value, const std::string& setting, const std::string& than) {
  return [holds = less(value, setting, than)](const CacheRows& rows) {
    const Answered found = holds.at(rows, {rows.front().drive, rows.front().rays});
    return Cases{.all = {{"", 0, found.answer, found.value, found.note}}, .form = holds.form};
  };
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
  const AtPoint saved = saves(settings);
  const auto one_saves = [&](uint64_t n) { return saved.at(rows, {rows.front().drive, n}).answer == Answer::yes; };
  return {{"device", device}, {"rays", grouped(rows.front().rays)}, {"saves", where_words(rays_of(rows), one_saves)}};
}

}  // namespace wavetracer::study
