// SPDX-License-Identifier: Apache-2.0
// Tests experiments on caching without a device: the thesis' parameters, tables, and paragraphs of made-up rows.
// Numbers are chosen so that the verdicts are known by hand.
#include <doctest/doctest.h>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include "contains.hpp"
#include "study/cache_claims.hpp"
#include "study/cache_rows.hpp"
#include "study/city.hpp"
#include "study/experiment.hpp"
#include "study/made_cache_rows.hpp"
#include "study/run.hpp"
#include "study/squeezed.hpp"
#include "study/worlds.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

// The config of a setting of a figure, by name.
Config config_of(const std::string& figure, const std::string& setting, uint64_t rays = 50000) {
  Config config = city();
  config.trace.rays = rays;
  uncached(config);
  for (const Setting& one : find_experiment(figure).study()->settings)
    if (one.name == setting) {
      one.apply(config);
      return config;
    }
  throw std::logic_error(figure + " has no setting " + setting);
}

std::string words_of(const std::string& figure, const std::vector<uint64_t>& rays, const CacheCost& cost) {
  const Experiment& experiment = find_experiment(figure);
  return squeezed(words_text(show(experiment, made_measurement(*experiment.study(), rays, cost), {}).words));
}

}  // namespace

TEST_CASE("every figure of chapter 6 is a experiment, and those of caching know a study and a view") {
  for (int figure = 1; figure <= 18; ++figure) {
    const Experiment& experiment = find_experiment("figure-6." + std::to_string(figure));
    const bool caching = figure != 1 && figure != 13 && figure != 18;
    CHECK((experiment.study() != nullptr) == caching);
  }
  CHECK(find_experiment("figure-6.2").study() == find_experiment("figure-6.3").study());
  CHECK(find_experiment("figure-6.13").as<FrameFigure>()->frames == 100);
}

TEST_CASE("figures 6.2 to 6.5: chained, 50,000 entries, load factor 3, division 200,000") {
  CHECK(find_experiment("figure-6.2").study()->rays == std::vector<uint64_t>{50000});
  for (const std::string figure : {"figure-6.2", "figure-6.5"})
    for (const auto& [name, hash] :
         std::map<std::string, uint32_t>{{"chained uniform", 1}, {"chained Morton", 2}, {"chained mixed", 3}}) {
      const CacheConfig cache = config_of(figure, name).cache;
      CHECK(cache.kind.word() == "chained");
      CHECK(cache.hash_method == hash);
      CHECK(cache.buffer_size == 50000);
      CHECK(cache.load_factor == 3);
      CHECK(cache.division == 200000);
      CHECK(cache.scope.word() == "all");
      CHECK(cache.hit_point.word() == "cached");
      CHECK_FALSE(cache.statistics);
    }
  CHECK(config_of("figure-6.5", "chained mixed 500000 entries").cache.buffer_size == 500000);
  CHECK(config_of("figure-6.4", "chained Morton counted").cache.statistics);
  const std::vector<uint64_t> rays = find_experiment("figure-6.5").study()->rays;
  CHECK(rays.front() == 1000);
  CHECK(rays.back() == 20480000);
  for (size_t i = 1; i + 1 < rays.size(); ++i) CHECK(rays[i] == 2 * rays[i - 1]);
}

TEST_CASE("figures 6.6 to 6.9: open, 300,000 entries, mutex or 5 readers, the last with rays in order") {
  const Config mutex = config_of("figure-6.6", "mutex mixed"), readers = config_of("figure-6.8", "readers Morton"),
               ordered = config_of("figure-6.9", "mutex uniform"), plain = config_of("figure-6.9", "no cache");
  for (const Config& config : {mutex, readers, ordered}) {
    CHECK(config.cache.kind.word() == "open");
    CHECK(config.cache.buffer_size == 300000);
    CHECK(config.cache.division == 200000);
    CHECK(config.trace.directions.word() == "random");
  }
  CHECK(mutex.cache.locking.word() == "mutex");
  CHECK(ordered.cache.locking.word() == "mutex");
  CHECK(readers.cache.locking.word() == "readers");
  CHECK(readers.cache.readers_number == 5);
  CHECK(mutex.order.method.word() == "none");
  CHECK(ordered.order.method.word() == "hilbert3d-histogram");
  CHECK(plain.order.method.word() == "hilbert3d-histogram");
  CHECK(plain.cache.kind.word() == "none");
}

TEST_CASE("figures 6.11 to 6.17: position 200,000, precision 10,000 with 0.0125 and 0.093, no sequences reused") {
  const Config by_position = config_of("figure-6.11", "position mixed"),
               by_precision = config_of("figure-6.11", "precision 0.0125 mixed"),
               of_errors = config_of("figure-6.12", "precision 0.093 mixed");
  CHECK(by_position.cache.purge.word() == "position");
  CHECK(by_position.cache.division == 200000);
  for (const Config& config : {by_precision, of_errors}) {
    CHECK(config.cache.purge.word() == "precision");
    CHECK(config.cache.division == 10000);
  }
  CHECK(by_precision.cache.residual_value == 0.0125);
  CHECK(of_errors.cache.residual_value == 0.093);
  for (const Config& config : {by_position, by_precision, of_errors}) {
    CHECK(config.cache.kind.word() == "open");
    CHECK(config.cache.locking.word() == "readers");
    CHECK(config.cache.scope.word() == "all");
    CHECK(config.cache.hit_point.word() == "cached");
    CHECK_FALSE(config.trace.reuse);
  }
  CHECK(config_of("figure-6.11", "no cache with reuse").trace.reuse);
  CHECK(config_of("figure-6.11", "concurrent exact").cache.key.word() == "exact");
  CHECK(config_of("figure-6.11", "concurrent").cache.scope.word() == "static");
  CHECK(find_experiment("figure-6.11").study()->rays.front() == 1000);
  CHECK(find_experiment("figure-6.11").study()->rays.back() == 900000);  // ten times the thesis' range
  CHECK(find_experiment("figure-6.14").study()->rays.back() == 490000);
  CHECK(find_experiment("figure-6.16").study()->rays.back() == 610000);
  CHECK(config_of("figure-6.16", "precision 0.0125 Morton").cache.hash_method == 2);
  CHECK(config_of("figure-6.16", "precision 0.0125 Morton").order.method.word() == "hilbert3d-histogram");
}

TEST_CASE("every setting of every study is a config that reads back") {
  for (const Experiment& experiment : study::experiments()) {
    if (!experiment.study()) continue;
    std::set<std::string> drives(experiment.study()->drives.begin(), experiment.study()->drives.end());
    for (const std::string& drive : drives)
      for (const Setting& setting : experiment.study()->settings) {
        CAPTURE(experiment.name);
        CAPTURE(setting.name);
        CHECK(setting.name.find(',') == std::string::npos);  // a cell of a table
        Config config = drive == "still" ? city() : with_traffic(city(), drive, 500);
        config.trace.rays = experiment.study()->rays.back();
        uncached(config);
        setting.apply(config);
        CHECK_NOTHROW(parse_config(resolved_config(config), "resolved.toml"));
      }
    for (const uint64_t few : experiment.study()->few_rays)
      CHECK((std::count(experiment.study()->rays.begin(), experiment.study()->rays.end(), few) == 1));
  }
}

TEST_CASE("numbers of rays and frames: by device, by request") {
  const CacheStudy& study = *find_experiment("figure-6.11").study();
  Request request;
  CHECK(study_rays(study, request, true) == study.rays);
  CHECK(study_rays(study, request, false) == study.few_rays);
  CHECK(study_frames(study, request, true) == 500);
  CHECK(study_frames(study, request, false) == 20);
  request.rays = RayRange{40000, 80000};
  CHECK(study_rays(study, request, false) == std::vector<uint64_t>{49000, 70000});
  request.rays = RayRange{2000, 3000};
  CHECK_THROWS_WITH_AS(study_rays(study, request, false), doctest::Contains("of which none lies in it"), ConfigError);
  request = {};
  request.quick = true;
  CHECK(study_rays(study, request, true) == study.few_rays);
  CHECK(study_frames(study, request, true) == 100);
  request.frames = 7;
  CHECK(study_frames(study, request, true) == 7);
}

TEST_CASE("rows: nanoseconds a segment, hit rate, savings, columns") {
  CacheRow row;
  row.cold.store_s = 3e-6;
  row.cold.trace_s = 9e-6;
  row.warm.lookup_s = 2e-6;
  row.cold_counts = {100, 100, 40};
  row.counts = {100, 50, 20};
  CHECK(write_ns(row) == doctest::Approx(50));  // 60 that missed
  CHECK(trace_ns(row) == doctest::Approx(150));
  CHECK(read_ns(row) == doctest::Approx(40));
  CHECK(hit_rate(row) == doctest::Approx(0.4));
  CHECK(std::isnan(hit_rate(CacheRow{})));
  std::vector<CacheRow> point(2, row);
  point[0].warm.loop_s = 4;
  point[1].warm.loop_s = 3;
  set_savings(point);
  CHECK(point[0].saved_percent == 0);
  CHECK(point[1].saved_percent == doctest::Approx(25));
  const std::string table = csv_of(cache_columns(), point).text();
  CHECK(std::count(table.begin(), table.end(), '\n') == 3);
  CHECK(std::count(table.begin(), table.end(), ',') == 3 * (static_cast<long>(cache_columns().size()) - 1));
  CHECK(value_of(point[1], "saved_percent") == doctest::Approx(25));
  CHECK(std::isnan(value_of(point[1], "setting")));
  CHECK(std::isnan(value_of(point[1], "no such column")));
}

TEST_CASE("stages that discover are summed, others are not") {
  const CacheTimes times = cache_times({{"generate_rays", 1},
                                        {"cache_lookup", 2},
                                        {"cache_store", 4},
                                        {"cache_gather", 8},
                                        {"trace", 16},
                                        {"trace_moving", 32},
                                        {"interact", 64},
                                        {"cache_purge", 128},
                                        {"cache_groups", 256},
                                        {"solve", 1000},
                                        {"frame", 5000}});
  CHECK(times.loop_s == 511);
  CHECK(times.group_s == 256);
  CHECK(times.trace_s == 48);
  CHECK(times.lookup_s == 2);
  CHECK(times.store_s == 4);
  CHECK(times.gather_s == 8);
  CHECK(times.purge_s == 128);
}

TEST_CASE("phrases") {
  CHECK(saved_words(12.3) == "12% less time");
  CHECK(saved_words(-3.04) == "3.0% more time");
  CHECK(saved_words(0.4) == "the same time");
  CHECK(share_words(0) == "none");
  CHECK(share_words(0.00031) == "0.031%");
  CHECK(share_words(2.3e-8) == "less than 0.001%");
  CHECK(share_words(0.996) == "100%");
  const std::vector<uint64_t> rays = {1000, 2000, 4000};
  CHECK(where_words(rays, [](uint64_t n) { return n > 1000; }) == "at 2,000 and 4,000 rays");
  CHECK(where_words(rays, [](uint64_t) { return true; }) == "at every number of rays");
  CHECK(where_words(rays, [](uint64_t) { return false; }) == "at none of the numbers of rays");
}

TEST_CASE("figure-6.5: no gain outside of the window and one inside is what the thesis finds") {
  const auto as_claimed = [](const std::string& setting, uint64_t rays) {
    const bool inside = rays >= 2560000 && rays <= 10240000;
    return std::pair{setting.starts_with("chained") && !inside ? 1.25 : setting == "chained mixed" ? 0.8 : 1.0, 0.0};
  };
  const std::string claimed = words_of("figure-6.5", {1000, 4096000, 20480000}, as_claimed);
  CAPTURE(claimed);
  CHECK(contains(claimed, "one of them saves time at 4,096,000 rays."));
  CHECK(contains(claimed,
                 "| no gain below 2,560,000 rays | not measured there | measured from 1,000 to 20,480,000 rays |\n"
                 "| a gain from 2,560,000 to 10,240,000 rays | reproduced | yes at 4,096,000 rays (20% less time) |\n"
                 "| no gain beyond 10,240,000 rays | reproduced | yes at 20,480,000 rays (25% more time) |"));
  CHECK(contains(claimed, "At 20,480,000 rays, against the same rays without a cache:"));
  const std::string never = words_of("figure-6.5", {1000, 4096000}, [](const std::string&, uint64_t) {
    return std::pair{1.0, 0.0};
  });
  CHECK(contains(
      never, "| a gain from 2,560,000 to 10,240,000 rays | undecided | undecided at 4,096,000 rays (the same time) |"));
  const std::string few = words_of("figure-6.5", {1000, 2000}, [](const std::string& setting, uint64_t) {
    return std::pair{setting == "chained uniform" ? 0.5 : 1.0, 0.0};
  });
  CHECK(contains(
      few, "| a gain from 2,560,000 to 10,240,000 rays | not measured there | measured from 1,000 to 2,000 rays |"));
  CHECK(contains(few, "| chained uniform | 50% less time |"));
}

TEST_CASE("figure-6.8: verdicts beyond 50,000 rays only") {
  const auto late = [](const std::string& setting, uint64_t rays) {
    return std::pair{rays > 50000 && setting == "readers mixed" ? 0.9 : 1.0, 0.0};
  };
  const std::string text = words_of("figure-6.8", {1000, 64000, 128000}, late);
  CHECK(contains(text,
                 "| a gain beyond 50,000 rays | reproduced | yes at 64,000 and 128,000 rays (10% less time) |\n"
                 "| the mixed hash is the fastest beyond 50,000 rays | reproduced | yes at 64,000 and 128,000 rays "
                 "(readers mixed over the next: 0.90) |"));
  CHECK(contains(words_of("figure-6.8", {1000}, late),
                 "| a gain beyond 50,000 rays | not measured there | measured at 1,000 rays |"));
}

TEST_CASE("figures 6.11 and 6.12: claims by number of rays, errors in metres and of the mean path") {
  const auto cost = [](const std::string& setting, uint64_t rays) {
    if (setting == "position mixed") return std::pair{rays == 1000 ? 0.85 : 0.95, rays == 1000 ? 8.0 : 1.5};
    if (setting == "precision 0.093 mixed") return std::pair{1.0, 5.0};
    return std::pair{1.0, 0.0};
  };
  const std::string times = words_of("figure-6.11", {1000, 49000}, cost),
                    errors = words_of("figure-6.12", {1000, 49000}, cost);
  CHECK(
      contains(times,
               "| 10% less time if purged by position, for small and medium numbers of rays (up to 50,000) | in part | "
               "fixed transmitter: yes at 1,000 rays, no at 49,000 rays (15% less time to 5.0% less time); "));
  CHECK(contains(times,
                 "| 17% less time if purged by precision, for many rays (from 70,000 to 90,000) | not measured there | "
                 "measured from 1,000 to 49,000 rays |"));
  CHECK(contains(times, "| fixed transmitter | position mixed | 5.0% less time |"));
  CHECK(contains(errors,
                 "| off by 2 m at most if purged by position, beyond the first number of rays | reproduced | fixed "
                 "transmitter: yes at 49,000 rays (1.50 m); "));
  CHECK(
      contains(errors,
               "| off by 7 m at most by precision 0.093 | reproduced | fixed transmitter: yes at 1,000 and 49,000 rays "
               "(5.00 m); "));
  CHECK(contains(errors,
                 "| off farther by precision than by position | in part | fixed transmitter: yes at 49,000 rays, no at "
                 "1,000 rays (position mixed over precision 0.093 mixed: 0.30 to 1.60); "));
  CHECK(contains(errors, "| 10% | 0.10% (-30.0 dB) | "));
  CHECK(contains(errors, "| 5.0 m |"));
  CHECK(contains(errors, "| none | none | none | undefined | right |\n"));
}

TEST_CASE("figure 6.4: entries along the table") {
  const auto same = [](const std::string&, uint64_t) { return std::pair{1.0, 0.0}; };
  const Experiment& experiment = find_experiment("figure-6.4");
  const Findings along = show(experiment, made_measurement(*experiment.study(), {50000}, same), {});
  const std::string along_table = along.figure.data.front().text;
  CHECK(along_table.starts_with("drive,setting,first_slot,entries,hits\nstill,chained uniform,0,500,2.5\n"));
  CHECK(contains(along_table, "still,printed chained mixed,500,500,1.5\n"));
  const std::string text = squeezed(words_text(along.words));
  CHECK(contains(text, "| chained Morton | 50,000 | 1,000 | 100 | 0.800 | 6.00 |"));
  CHECK(contains(text, "| hits are spread over the entries at least as evenly as by chance | reproduced | "));
  CHECK(contains(text, "| there are no clusters of busy entries | undecided | "));
  CHECK(contains(text, "| some entries are left unused | reproduced | \"chained uniform counted\": yes (98%)"));
}

TEST_CASE("all figures of caching: a script with a line per setting, whose columns are in the table") {
  for (const Experiment& experiment : study::experiments()) {
    if (!experiment.study()) continue;
    CAPTURE(experiment.name);
    const Findings found = show(experiment,
                                made_measurement(*experiment.study(), {1000, 2000},
                                                 [](const std::string&, uint64_t) {
                                                   return std::pair{1.0, 0.5};
                                                 }),
                                {});
    CHECK(contains(found.figure.commands, "'" + experiment.name + ".csv' using"));
    CHECK(contains(found.words.paragraph, "the device"));
    REQUIRE_FALSE(found.words.numbers.rows.empty());
    for (const auto& row : found.words.numbers.rows) CHECK(row.size() == found.words.numbers.heads.size());
    CHECK(found.figure.data.front().text.find(',') != std::string::npos);
    CHECK_FALSE(experiment.caption.empty());
  }
  const Experiment& experiment = find_experiment("figure-6.5");
  CHECK(show(experiment, CacheMeasurement{}, {}).points == 0);  // interrupted before the first
}

TEST_CASE("line plots: unknown columns are mistakes, panels without a value are left out") {
  LinePlot plot;
  plot.name = "a";
  const Csv table({"drive", "setting", "rays", "value"});
  plot.settings = {"it's"};
  plot.x = "rays";
  plot.panels = {{"one", "value", "m", "still"}};
  CHECK(
      contains(line_figure(plot, table).commands, "strcol(2) eq 'it''s' && strcol(1) eq 'still' ? (column(4)) : NaN"));
  plot.panels[0].y = "values";
  CHECK_THROWS_AS(line_figure(plot, table), std::logic_error);
  CacheRow row{.drive = "still"};
  CHECK(panels_of({row}, {{"a", "l2_m", "m", ""}, {"b", "warm_s", "s", ""}}).size() == 1);
}
