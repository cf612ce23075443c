// SPDX-License-Identifier: Apache-2.0
// Trials of the claims of figures 6.11, 6.12 and 6.14 to 6.17.
// Names of settings are those of the studies.
#include "study/claim_trials.hpp"

namespace claim_trials {
namespace {

using Trials = std::vector<Trial<CacheRow>>;

const std::string position = "position ", precision = "precision 0.0125 ", position_mixed = "position mixed",
                  precision_mixed = "precision 0.0125 mixed", coarse = "precision 0.093 mixed";

// Seconds that grow, or fall, with the number of rays.
CacheCost with_rays(const std::string& setting, double few_s, double many_s) {
  return [=](const std::string& one, uint64_t rays) {
    return std::pair{one == setting ? (rays <= 1000 ? few_s : many_s) : 1.0, 0.0};
  };
}

void add_purging_times(Trials& out) {
  const auto time = [&](const std::string& words, const std::string& setting, double yes_s, double no_s) {
    out.push_back(trial("figure-6.11", words, taking({{setting, yes_s}}), taking({{setting, no_s}})));
  };
  time("constantly less time than no cache if purged by position", position_mixed, 0.9, 1.1);
  time("10% less time if purged by position, for small and medium numbers of rays (up to 50,000)", position_mixed, 0.88,
       0.95);
  time("15% less time if purged by position, for many rays (from 70,000 to 90,000)", position_mixed, 0.8, 0.9);
  time("17% less time if purged by precision, for many rays (from 70,000 to 90,000)", precision_mixed, 0.8, 0.9);
  time("30% less time if purged by precision, for few and medium numbers of rays (up to 50,000)", precision_mixed, 0.6,
       0.8);
  time("less time than no cache if purged by precision", precision_mixed, 0.9, 1.1);
  time("less time by precision than by position", precision_mixed, 0.9, 1.1);
  time("as printed: 10% less time if purged by position", "printed " + position_mixed, 0.88, 0.95);
  time("as printed: 17% less time if purged by precision", "printed " + precision_mixed, 0.8, 0.9);
  out.push_back(trial("figure-6.11", "the difference grows with the number of rays if purged by position",
                      with_rays(position_mixed, 0.95, 0.8), with_rays(position_mixed, 0.8, 0.95)));
}

void add_purging_errors(Trials& out) {
  const auto error = [&](const std::string& words, const Numbers& yes, const Numbers& no) {
    out.push_back(trial("figure-6.12", words, off(yes), off(no)));
  };
  for (const std::string kind : {"", "printed "}) {
    const std::string as = kind.empty() ? "" : "as printed: ";
    error(as + "off by some 8 m if purged by position, at the first number of rays", {{kind + position_mixed, 8}},
          {{kind + position_mixed, 2}});
    error(as + "off by 2 m at most if purged by position, beyond the first number of rays",
          {{kind + position_mixed, 1}}, {{kind + position_mixed, 3}});
    error(as + "off by 7 m at most by precision 0.093", {{kind + coarse, 5}}, {{kind + coarse, 8}});
    error(as + "on average three times as far by precision as by position",
          {{kind + coarse, 6}, {kind + position_mixed, 2}}, {{kind + coarse, 2}, {kind + position_mixed, 2}});
  }
  error("off farther by precision than by position", {{coarse, 3}, {position_mixed, 2}},
        {{coarse, 2}, {position_mixed, 3}});
  error("reasonable, within 10% of the mean path, if purged by position", {{position_mixed, 5}},
        {{position_mixed, 20}});
  error("reasonable, within 10% of the mean path, by precision 0.093", {{coarse, 5}}, {{coarse, 20}});
}

void add_hash_times(Trials& out) {
  const auto time = [&](const std::string& words, const Numbers& yes, const Numbers& no) {
    out.push_back(trial("figure-6.14", words, taking(yes), taking(no)));
  };
  const Numbers all_faster = {{position + "uniform", 0.9},
                              {position + "Morton", 0.9},
                              {position + "mixed", 0.9},
                              {precision + "uniform", 0.9},
                              {precision + "mixed", 0.9}};
  Numbers one_slower = all_faster;
  one_slower.back().second = 1.1;
  time("by precision, Morton codes take the most time of all", {{precision + "Morton", 1.2}},
       {{precision + "Morton", 0.8}});
  time("the second worst is no cache: all others save time", all_faster, one_slower);
  time("by position, the uniform hash takes less time than no cache", {{position + "uniform", 0.9}},
       {{position + "uniform", 1.1}});
  time("by position, Morton codes take 15% less time than the uniform hash, from 20,000 rays on",
       {{position + "Morton", 0.8}}, {{position + "Morton", 0.95}});
  time("by position, the mixed hash takes the time of the uniform one", {{position + "mixed", 1.01}},
       {{position + "mixed", 1.2}});
  time("by precision, Morton codes take more time than no cache", {{precision + "Morton", 1.1}},
       {{precision + "Morton", 0.9}});
  time("by precision, the mixed hash takes the time of the uniform one", {{precision + "mixed", 1.01}},
       {{precision + "mixed", 1.2}});
  time("by precision, the uniform hash takes the time of Morton codes by position", {{precision + "uniform", 1.02}},
       {{precision + "uniform", 1.3}});
  time("by precision, the mixed hash takes the time of Morton codes by position", {{precision + "mixed", 1.02}},
       {{precision + "mixed", 1.3}});
  time(
      "Morton codes by position take less time than the uniform hash by precision, for many rays (from 37,000 to "
      "49,000)",
      {{position + "Morton", 0.9}}, {{position + "Morton", 1.1}});
}

void add_hash_errors(Trials& out) {
  const auto error = [&](const std::string& words, const std::string& a, const std::string& b,
                         std::pair<double, double> yes, std::pair<double, double> no) {
    out.push_back(
        trial("figure-6.15", words, off({{a, yes.first}, {b, yes.second}}), off({{a, no.first}, {b, no.second}})));
  };
  for (const std::string kind : {"", "printed "}) {
    const std::string as = kind.empty() ? "" : "as printed: ", by_position = kind + position,
                      by_precision = kind + precision;
    error(as + "by position, on average twice as far off with Morton codes as with the uniform hash",
          by_position + "Morton", by_position + "uniform", {4, 2}, {2, 2});
    error(as + "by position, as far with the mixed hash as with the uniform one", by_position + "mixed",
          by_position + "uniform", {2, 2}, {4, 2});
    error(as + "by precision, less far with Morton codes than with the uniform hash", by_precision + "Morton",
          by_precision + "uniform", {1, 2}, {2, 1});
  }
  error("by position, the centroid is off farther with Morton codes than with the uniform hash", position + "Morton",
        position + "uniform", {3, 2}, {2, 3});
  error("by precision, as far with the mixed hash as with the uniform one", precision + "mixed", precision + "uniform",
        {2, 2}, {4, 2});
  error("Morton codes are off less far by position than by precision", position + "Morton", precision + "Morton",
        {4, 5}, {5, 4});
  const Numbers farthest = {{precision + "uniform", 5}, {precision + "mixed", 4}, {position + "mixed", 1}},
                near = {{precision + "uniform", 5}, {precision + "mixed", 1}, {position + "mixed", 4}};
  out.push_back(trial("figure-6.15", "by precision, the uniform and the mixed hash are off farthest of all",
                      off(farthest), off(near)));
}

void add_ordered(Trials& out) {
  const auto time = [&](const std::string& words, const std::string& setting, double yes_s, double no_s) {
    out.push_back(trial("figure-6.16", words, taking({{setting, yes_s}}), taking({{setting, no_s}})));
  };
  time("without a cache, reordering gives 2.5 times the speed at 49,000 rays", "unsorted no cache", 3, 2);
  // The sort takes half of the second of a frame in order.
  const auto sorted = [](CacheRow& row) { row.order_s = row.setting.starts_with("unsorted") ? 0 : 0.5; };
  out.push_back(trial("figure-6.16",
                      "without a cache, reordering gives 2.5 times the speed at 49,000 rays, the sort counted once",
                      taking({{"unsorted no cache", 1.6}}), taking({{"unsorted no cache", 1.1}}), sorted, sorted));
  out.push_back(trial("figure-6.16", "caches by position, and by precision with Morton codes, save no time",
                      taking({{position + "uniform", 1.1},
                              {position + "Morton", 1.1},
                              {position + "mixed", 1.1},
                              {precision + "Morton", 1.1}}),
                      taking({{position + "Morton", 0.8}})));
  for (const std::string hash : {"uniform", "mixed"}) {
    time("by precision, the " + hash + " hash is faster than no cache, up to 37,000 rays", precision + hash, 0.9, 1.1);
    time("by precision, the " + hash + " hash takes noticeably more time than no cache at 61,000 rays",
         precision + hash, 1.2, 1.0);
    out.push_back(trial("figure-6.17", "around 5 m by precision with the " + hash + " hash",
                        off({{precision + hash, 5}}), off({{precision + hash, 9}})));
  }
  const auto error = [&](const std::string& words, const Numbers& yes, const Numbers& no) {
    out.push_back(trial("figure-6.17", words, off(yes), off(no)));
  };
  error("the centroid is off farther by precision than by position, with the uniform hash",
        {{precision + "uniform", 3}, {position + "uniform", 2}},
        {{precision + "uniform", 2}, {position + "uniform", 3}});
  for (const auto& [by, setting] :
       {std::pair{std::string("position"), position_mixed}, {std::string("precision"), precision_mixed}})
    error("sorting reduces the error by " + by, {{setting, 1}, {"unsorted " + setting, 2}},
          {{setting, 2}, {"unsorted " + setting, 1}});
}

// Gives the rows of a setting to its printed twin, and the other way.
std::string swapped(const std::string& setting) {
  const std::string unsorted = "unsorted ", printed = "printed ";
  const std::string before = setting.starts_with(unsorted) ? unsorted : "", name = setting.substr(before.size());
  if (name == "no cache") return setting;
  return before + (name.starts_with(printed) ? name.substr(printed.size()) : printed + name);
}

// Returns the same trials for tables as printed, where a figure has such claims.
Trials as_printed(const Trials& trials) {
  Trials out;
  for (const Trial<CacheRow>& one : trials) {
    const bool judged = one.figure == "figure-6.14" || one.figure == "figure-6.16" || one.figure == "figure-6.17";
    if (!judged || one.words.starts_with("as printed") || one.words.starts_with("without a cache") ||
        one.words.find("for many rays") != std::string::npos)
      continue;
    Trial<CacheRow> twin = one;
    twin.words = "as printed: " + one.words;
    for (auto* rows : {&twin.yes, &twin.no, &twin.third})
      *rows = [of = *rows] {
        CacheRows out_rows = of();
        for (CacheRow& row : out_rows) row.setting = swapped(row.setting);
        return out_rows;
      };
    out.push_back(twin);
  }
  return out;
}

}  // namespace

std::vector<Trial<CacheRow>> traffic_trials() {
  Trials out;
  add_purging_times(out);
  add_purging_errors(out);
  add_hash_times(out);
  add_hash_errors(out);
  add_ordered(out);
  const Trials twins = as_printed(out);
  out.insert(out.end(), twins.begin(), twins.end());
  return out;
}

}  // namespace claim_trials
