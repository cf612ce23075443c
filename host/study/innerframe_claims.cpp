// SPDX-License-Identifier: Apache-2.0
// Turns rows into answers.
// A row that was not measured answers nothing.
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

// The share of lost paths; its noise is that of a sample of so many paths.
Measured lost_share(const CacheRow& row) {
  const double share = row.error.lost_share, paths = static_cast<double>(row.error.reference_paths);
  return {share, paths > 0 ? std::sqrt(share * (1 - share) / paths) : undefined};
}

// Returns the rows with groups, each with the measured factor that it saves.
template <class Factor>
Judge<CacheRow> largest_reaches(double claimed, Factor factor) {
  return [=](const CacheRows& rows) {
    Cases out{.form = {"up to ", [](double value) { return plain(value); }, " times"}};
    Measured most;
    for (const CacheRow& row : rows)
      if (row.counts.groups > 0)
        if (const Measured found = factor(rows, row); std::isnan(most.value) || found.value > most.value) most = found;
    if (!std::isnan(most.value)) out.all.push_back({"", 0, reaches(most, claimed), most.value});
    return out;
  };
}

// Answers for each number of rays; `holds` gets the rows of these settings there, of which there is one at least.
template <class Holds>
Judge<CacheRow> by_count(std::vector<std::string> settings, const ValueForm& form, Holds holds) {
  return [=](const CacheRows& rows) {
    Cases out{.form = form};
    for (const uint64_t rays : rays_of(rows)) {
      RowList there;
      for (const CacheRow* row : rows_of_settings(rows, settings))
        if (row->rays == rays) there.push_back(row);
      if (there.empty()) continue;
      const Answered found = holds(rows, there);
      out.all.push_back({"", rays, found.answer, found.value, found.note});
    }
    return out;
  };
}

}  // namespace

Judge<CacheRow> one_ray_a_group(std::vector<std::string> settings) {
  return by_count(std::move(settings), factor_form(), [](const CacheRows&, const RowList& there) -> Answered {
    double farthest = 1;
    bool exact = true;
    for (const CacheRow* row : there) {
      if (row->counts.groups == 0) return {Answer::no, undefined, "there are no groups"};
      const double ratio = row->counts.traced() / row->counts.groups;
      if (std::abs(ratio - 1) > std::abs(farthest - 1)) farthest = ratio;
      exact = exact && std::abs(row->counts.traced() - row->counts.groups) < 0.5;  // means over frames
    }
    if (exact) return {Answer::yes, farthest};
    // A frame of few groups may differ by one of them.
    return {std::abs(farthest - 1) < least_noise ? Answer::undecided : Answer::no, farthest};
  });
}

Judge<CacheRow> somewhere_faster(std::vector<std::string> settings, double most_lost) {
  return by_count(std::move(settings), time_form(), [=](const CacheRows& rows, const RowList& there) -> Answered {
    Answered best{Answer::no, undefined, ""};
    for (const CacheRow* row : there) {
      const Measured share = share_of_none(rows, *row);
      const Answer saved = below(share, 1),
                   answer = std::min(saved, row->error.lost_share <= most_lost ? Answer::yes : Answer::no);
      if (answer > best.answer || (answer == best.answer && !(share.value >= best.value)))
        best = {answer, share.value, ""};
    }
    return best;
  });
}

Judge<CacheRow> fewer_traced_times(double claimed) {
  return largest_reaches(claimed, [](const CacheRows&, const CacheRow& row) {
    return Measured{row.counts.segments / row.counts.traced(), 0};
  });
}

Judge<CacheRow> times_as_fast(double claimed) {
  return largest_reaches(claimed, [](const CacheRows& rows, const CacheRow& row) {
    return quotient({1, 0}, share_of_none(rows, row));
  });
}

Judge<CacheRow> error_grows(std::vector<std::string> settings) {
  return by_count(settings, {}, [settings](const CacheRows&, const RowList& there) -> Answered {
    CacheRows own;
    for (const CacheRow* row : there) own.push_back(*row);
    std::vector<Answer> answers;
    for (const RowList& ladder : ladders(own, settings))
      if (ladder.size() > 1) answers.push_back(less(lost_share(*ladder.front()), lost_share(*ladder.back())));
    return {all_of(answers)};
  });
}

Judge<CacheRow> error_is_controlled(std::vector<std::string> settings, double factor, double negligible) {
  return [=](const CacheRows& rows) {
    // Keys are setting, world and index in the ladder, which stands for one C_E; values are the shares at all numbers
    // of rays.
    std::map<std::string, std::map<std::pair<std::string, size_t>, std::vector<Measured>>> shares;
    for (const RowList& ladder : ladders(rows, settings))
      for (size_t step = 0; step < ladder.size(); ++step)
        shares[ladder[step]->setting][{ladder[step]->drive, step}].push_back(lost_share(*ladder[step]));
    Cases out{.form = factor_form()};
    for (const auto& [setting, steps] : shares) {
      std::vector<Answer> answers;
      double largest = undefined;
      for (const auto& [key, values] : steps) {
        if (values.size() < 2) continue;
        const auto [low, high] = std::ranges::minmax(values, {}, &Measured::value);
        if (high.value < negligible) {
          answers.push_back(Answer::yes);
          continue;
        }
        answers.push_back(opposite(less(factor * low, high)));
        if (low.value > 0 && !(largest >= high.value / low.value)) largest = high.value / low.value;
      }
      out.all.push_back({'"' + setting + '"', 0, all_of(answers), largest});
    }
    return out;
  };
}

}  // namespace wavetracer::study
