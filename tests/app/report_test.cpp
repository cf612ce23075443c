// SPDX-License-Identifier: Apache-2.0
// The closing report of a run, from invented results.
#include "app/report.hpp"
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <utility>
#include "output/run_advice.hpp"
#include "output/sample_run.hpp"
#include "program.hpp"

using namespace wavetracer;

TEST_CASE("the report says how much a ray cache answered and how full it is; without one, nothing") {
  const SampleRun sample;
  const auto report = [&](const CacheSummary& cache) {
    Results results{totals_of(sample.frames()), {}, {}};
    results.totals.cache = cache;
    results.totals.timed_segments = traced_segments(results.totals);
    return app::report(sample.run(), results, true);
  };
  CacheSummary cache;
  CHECK_FALSE(contains(report(cache), "cache"));
  cache.on = true;
  CHECK(contains(report(cache), "\ncache      0% of 0 look-ups answered, 0% of 0 entries in use\n"));
  cache.lookups = 2000;
  cache.hits = 1430;
  cache.entries = 400;
  cache.used = 50;
  CHECK(contains(report(cache), "\nrays       2,000 launched, 3,570 traced over all depths, 3,000 hits, 3.57 krays/s"));
  CHECK(contains(report(cache), "\ncache      71.5% of 2,000 look-ups answered, 12.5% of 400 entries in use\n"));
  CHECK_FALSE(contains(report(cache), "groups"));
  cache.groups = 60;
  cache.traced = 70;
  cache.shared = 500;
  CHECK(contains(report(cache), "60 groups of equal keys inside of frames: 70 segments traced, 500 took their hits\n"));
  CHECK(contains(report(cache), "\nrays       2,000 launched, 3,070 traced over all depths"));
}

TEST_CASE("the report names what was computed, and why not what was asked for beyond it") {
  SampleRun sample;
  const Results results{totals_of(sample.frames()), {}, {}};
  Run run = sample.run();  // diffraction is off, which is not reported by default
  const auto report = [&] { return app::report(run, results, true); };
  CHECK(contains(report(), "\nfeatures   reflection\n"));
  sample.config.trace.diffraction = true;
  CHECK(contains(report(), "\nfeatures   reflection; no diffraction: no edge of the scene diffracts\n"));
  run.summary.features["diffraction"] = {true, {}};
  run.summary.features["double_diffraction"] = {true, {}};
  CHECK(contains(report(), "\nfeatures   reflection, diffraction, double diffraction\n"));
  run.summary.features["air"] = {true, {}};
  CHECK(contains(report(), "\nfeatures   reflection, diffraction, double diffraction, air\n"));
  run.summary.features["beams"] = {false, "there are targets"};
  CHECK(contains(report(), ", double diffraction, air\n"));
  sample.config.trace.discovery = "auto";
  CHECK(contains(report(), ", double diffraction, air; no beams: there are targets\n"));
  run.summary.features["beams"] = {true, {}};
  CHECK(contains(report(), ", double diffraction, air, beams\n"));
  sample.config.trace.reflection = false;
  run.summary.features = {{"reflection", {false, "trace.reflection = false"}}};
  CHECK(contains(report(), "\nfeatures   line of sight alone\n"));
}

TEST_CASE("without line of sight on most links, diffraction that is off is advised") {
  SampleRun sample;
  Results results{totals_of(sample.frames()), {}, {}};  // line of sight on 1 of 8 links
  Run run = sample.run();
  const auto advised = [&] {
    const std::string text = app::report(run, results, true);
    CHECK(contains(text, "\nadvice     ") == !advice(run, results.totals).empty());
    return contains(text, "\nadvice     line of sight on 1 of 8 links, and trace.diffraction = false leaves out all");
  };
  CHECK_FALSE(advised());  // no edge of the sample diffracts
  run.summary.features["diffraction"].reason = "trace.diffraction = false";
  CHECK(advised());
  results.totals.links = 1745;
  CHECK(advice(run, results.totals).at(0).starts_with("line of sight on 1 of 1,745 links, "));
  results.totals.warnings = {"a link has no path; trace.diffraction = true may help"};
  CHECK_FALSE(advised());
  results.totals.warnings.clear();
  results.totals.links = 2;
  CHECK_FALSE(advised());
  results.totals.links = 8;
  results.totals.counts.paths = 0;
  CHECK_FALSE(advised());
  results.totals.counts.paths = 5;
  run.summary.features["diffraction"] = {true, {}};
  CHECK_FALSE(advised());
}

TEST_CASE("the report counts paths by kind, those that there are") {
  const SampleRun sample;
  Results results{totals_of(sample.frames()), {}, {}};
  CHECK(contains(app::report(sample.run(), results, true),
                 "\npaths      5: 1 line of sight, 1 reflected, 3 transmitted\n"));
  results.totals = totals_of(sample.empty());
  CHECK(contains(app::report(sample.run(), results, true), "\npaths      0\n"));
}

TEST_CASE("the report counts what was solved, or with spheres what was caught, and lists the files") {
  SampleRun sample;
  const Results results{totals_of(sample.frames()), {}, {"out/paths.h5", "out/waypoints.h5"}};
  CHECK(contains(app::report(sample.run(), results, true), "\nsequences  80 distinct, 24 candidates, 16 solved\n"));
  sample.config.trace.reception = "sphere";
  CHECK(contains(app::report(sample.run(), results, true), "\nsequences  80 distinct, 6 segments passed receivers\n"));
  CHECK(contains(app::report(sample.run(), results, true), "\nwritten    out/paths.h5, out/waypoints.h5\n"));
}

TEST_CASE("the report ends with what may have been missed, where that is known") {
  SampleRun sample;
  Results results{totals_of(sample.frames()), {}, {}};
  const auto report = [&] { return app::report(sample.run(), results, true); };
  CHECK_FALSE(contains(report(), "missed"));
  results.totals.missed = {
      .frames = 1, .paths = {6, 3, 2, 9}, .powers = {8e-6, 1e-6, 0, 0.4}, .amplitude = 0.02, .power = 1};
  CHECK(contains(report(),
                 "\nmissed     about 4 of 5 paths (0 to 23), 5e-06 of the power (0 to 3e-05): "
                 "a higher number of trace.rays finds more of them\n"));
  // Most paths are diffracted and a receiver launches rays of its own: too few of those are the reason.
  sample.config.trace.diffraction = true;
  const PathKindCounts kinds = std::exchange(results.totals.kinds, {1, 1, 0, 3});
  CHECK(path_kinds[3].word == "diffracted");
  sample.config.receivers = {};
  CHECK(contains(report(), ": a higher number of trace.rays finds more of them\n"));
  sample.config.receivers = {{.name = "phone"}};
  CHECK(contains(report(), ": a higher number of trace.diffraction_rays (at most trace.rays) finds more of them\n"));
  results.totals.kinds = kinds;
  sample.config.trace.diffraction = false;
  results.totals.missed = {.frames = 1, .paths = {0, 0, 0, 9}, .powers = {0, 0, 0, 0.4}, .amplitude = 0.9, .power = 1};
  sample.config.trace.rays = {};
  CHECK(contains(report(), "\nmissed     probably none of 5 paths (0 to 3), 0 of the power (0 to 0.03)\n"));
  results.totals.missed.paths = {6, 3, 2, 9};
  CHECK(contains(report(), ": a higher trace.recall finds more of them\n"));
}

TEST_CASE("where rays do not show what they missed, the report says so, and why, instead of \"probably none\"") {
  SampleRun sample;
  Results results{totals_of(sample.frames()), {}, {}};
  const auto report = [&] { return app::report(sample.run(), results, false); };
  results.totals.frames = 30;
  results.totals.missed = {.unknown = 30};
  CHECK(contains(report(),
                 "\nmissed     unknown: the rays do not show it, as a warning says; a higher number of "
                 "trace.rays does, and trace.discovery = \"beams\" misses none\n"));
  CHECK_FALSE(contains(report(), "probably none"));
  results.totals.missed = {.frames = 27, .unknown = 3, .paths = {0, 0, 0, 9}, .power = 1};
  CHECK(contains(report(), "\nmissed     probably none of 5 paths"));
  CHECK(contains(report(), "\n           unknown in 3 of 30 frames: the rays do not show it"));
  sample.config.cache.kind = "open";
  CHECK(contains(report(), " frames: the answers of a ray cache are no independent rays\n"));
  sample.config.trace.reception = "sphere";
  CHECK(contains(report(), " frames: the spheres of receivers catch no exact paths\n"));
}

TEST_CASE("with beams the report says to which depth it is complete, and but for what") {
  const SampleRun sample;
  Results results{totals_of(sample.frames()), {}, {}};
  CHECK_FALSE(contains(app::report(sample.run(), results, false), "\ncomplete "));
  results.totals.certificate = {.frames = 3, .depth = 5, .ends = 6, .left_out_sr = 1.6e-9};
  CHECK(contains(app::report(sample.run(), results, false),
                 "\ncomplete   every path of up to 5 reflections, but for beams of 1.6e-09 sr in all, 2.1e-11 of the "
                 "directions\n"));
  results.totals.certificate = {
      .frames = 3, .depth = 4, .edges = 2, .ends = 6, .left_out_sr = 1.6e-9, .left_out_power = 2e-12};
  CHECK(contains(app::report(sample.run(), results, false),
                 "\ncomplete   every path of up to 4 interactions, up to 2 of them at edges, but for beams "
                 "of 1.6e-09 sr in all, 2.1e-11 of the directions; a link misses at most -117 dB through them "
                 "by paths without an edge\n"));
  results.totals.certificate = {.frames = 3,
                                .depth = 64,
                                .any_depth = true,
                                .ends = 6,
                                .left_out_sr = 1.6e-9,
                                .left_out_power = 2e-12,
                                .weak_sr = 0.75,
                                .floor_db = -140};
  CHECK(
      contains(app::report(sample.run(), results, false),
               "\ncomplete   every path of any number of reflections with a gain of -140 dB or more between isotropic "
               "antennas, but for beams of 1.6e-09 sr in all, 2.1e-11 of the directions; a link misses at most -117 "
               "dB through them\n           weaker beams, with 0.0099 of the power, were not followed\n"));
}

TEST_CASE("the report says what frames without rays may lack") {
  SampleRun sample;
  sample.config.trace.discover_every_s = 0.1;
  Results results{totals_of(sample.frames()), {}, {}};
  const auto report = [&] { return app::report(sample.run(), results, true); };
  CHECK_FALSE(contains(report(), "\nlate "));
  results.totals.late = {.discoveries = 9, .paths = 1200, .power = 2e-6, .all = 1e-2, .largest_share = 0.003};
  CHECK(contains(report(),
                 "\nlate       1,200 paths with 0.0002 of the power (at most 0.003) "
                 "were new when rays were launched again, every 0.1 s: frames before that may lack them\n"));
  results.totals.late = {.discoveries = 9, .all = 1e-2};
  CHECK(contains(report(), "\nlate       no path was new when rays were launched again, every 0.1 s\n"));
}
