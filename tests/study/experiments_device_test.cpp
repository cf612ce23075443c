// SPDX-License-Identifier: Apache-2.0
// Tests `wavetracer thesis` as a user runs it: files, paragraph, errors, an interrupt. Ranges are small.
// Cases that need a device are skipped with a message if there is none.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <signal.h>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include "app/gate.hpp"
#include "study/experiment_program.hpp"
#include "study/occurrences.hpp"
#include "study/squeezed.hpp"

using namespace experiment_program;

TEST_CASE("thesis: errors say what is wrong before anything is measured") {
  const Folder folder;
  const std::string file = folder.file("a.toml", street), out = folder.path("out");
  check_error({"thesis", "figure-6.0", "-o", out}, 2, "no experiment \"figure-6.0\" among figure-6.1, figure-6.2, ");
  check_error({"thesis", "figure-6.1", "-o", out, "--rays", "2000:1000"}, 2, "--rays 2000:1000: not a range");
  check_error({"thesis", "figure-6.1", "-o", out, "--rays", "3000:4000"}, 2, "no ray count of the figure");
  check_error({"thesis", "figure-6.1", "-o", out, "--repeat", "0"}, 2, "--repeat");
  check_error({"thesis", "figure-6.1", "-o", out, "--set", "trace.rays=7"}, 2, "choose them with --rays A:B");
  check_error({"thesis", "figure-6.1", "-o", out, "-c", file, "--set", "trace.ray=7"}, 2,
              "did you mean \"trace.rays\"?");
  check_error({"thesis", "figure-6.1", "-o", out, "-c", folder.path("absent.toml")}, 2, "absent.toml: cannot be read");
  check_error({"thesis", "coherence-rays", "-o", out, "--rays", "1000:2000"}, 2,
              "launches 49,000 rays; leave --rays out");
  check_error({"thesis", "coherence-rays", "-o", out, "--set", "trace.rays=7"}, 2, "leave it out");
  check_error({"thesis", "figure-6.5", "-o", out, "--set", "cache.division=7"}, 2, "leave it out");
  check_error({"thesis", "all", "-o", out, "--set", "trace.rays=7"}, 2, "choose them with --rays A:B");
  check_error({"thesis", "coherence-rays", "-o", out, "--set", "trace.max_depth=0"}, 2, "give 1 or more");
  check_error({"thesis", "figure-6.1", "-o", file + "/out"}, 1, "cannot write there");
  CHECK(folder.entries() == 1);
}

TEST_CASE("thesis: a device that is not there exits 4") {
  if (!device_present()) return;
  const Folder folder;
  check_error({"thesis", "figure-6.18", "-o", folder.path("out"), "--device", "no such device"}, 4, "no such device");
  CHECK(folder.entries() == 0);
}

TEST_CASE("figure-6.1: table, plot and paragraph agree") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program(
      {"thesis", "figure-6.1", "-c", file, "-o", folder.path("out"), "--rays", "1000:2000", "--repeat", "2"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const auto rows = table(folder.path("out/figure-6.1.csv"));
  REQUIRE(rows.size() == 2 * 24);  // twelve of them with other numbers of bins
  const std::string report = contents(folder.path("out/figure-6.1.md"));
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const auto& base = rows[i - i % 24];
    CAPTURE(row.at("mnemonic"));
    CHECK(row.at("rays") == (i < 24 ? "1000" : "2000"));
    CHECK(base.at("mnemonic") == "WS");
    CHECK(number(row.at("trace_s")) > 0);
    CHECK(number(row.at("unpaid_s")) > number(row.at("trace_s")));
    CHECK(number(row.at("frame_s")) > 0);
    CHECK((number(row.at("order_s")) > 0) == (row.at("method") != "none"));
    if (row.at("mnemonic") != "born ordered") {
      CHECK(row.at("paths") == base.at("paths"));
      CHECK(row.at("sequences") == base.at("sequences"));
    }
    for (const std::string which : {"unpaid", "paid"})
      CHECK(number(row.at("gain_" + which)) ==
            doctest::Approx(number(base.at(which + "_s")) / number(row.at(which + "_s"))).epsilon(1e-4));
    if (row.at("mnemonic") == "H3DH" && row.at("shape") == "1d" && row.at("bins") == "16") {
      const std::string cell =
          fmt::format("{:.2f} | {:.2f} |", number(row.at("gain_unpaid")), number(row.at("gain_paid")));
      CHECK(contains(squeezed(report), i < 24 ? "| H3DH | " + cell : cell + "\n"));
    }
  }
  CHECK(contains(report, "thesis figure-6.1 -c "));
  CHECK(contains(report, "- device: "));
  CHECK(contains(squeezed(report), "2.5 times as fast as WS at 49,000 rays | not measured there |"));
  // Standard output is the words and tables of the report, then the files.
  CHECK(contains(report, run.out.substr(0, run.out.find("\n\nwritten"))));
  if (contains(run.err, "gnuplot is not installed")) return;
  const std::string plot = contents(folder.path("out/figure-6.1.svg"));
  CHECK(contains(run.out, folder.path("out/figure-6.1.svg")));
  CHECK(contains(plot, "<svg "));
  CHECK(contains(plot, "</svg>"));
  CHECK(occurrences(plot, "id=\"gnuplot_plot_") == 4 * (8 + 6));  // a line per series, sort not paid and paid
}

TEST_CASE("figure-6.18: averages over frames; without gnuplot it says what to install") {
  if (!device_present()) return;
  const Folder folder;
  std::filesystem::create_symlink("/usr/bin/ld", folder.path("ld"));  // PoCL calls it where kernels are not cached
  const Outcome run = run_program(
      {"thesis", "figure-6.18", "-o", folder.path("out"), "--rays", "1000:1000", "--set", "trace.max_depth=2"},
      {"PATH=" + folder.path()});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(contains(run.err, "apt-get install gnuplot-nox"));
  CHECK_FALSE(std::filesystem::exists(folder.path("out/figure-6.18.svg")));
  CHECK(std::filesystem::exists(folder.path("out/figure-6.18.gp")));
  const auto rows = table(folder.path("out/figure-6.18.csv"));
  REQUIRE(rows.size() == 6);
  for (const auto& row : rows) {
    CHECK(row.at("frames") == "20");
    CHECK(number(row.at("reduction_paid_percent")) ==
          doctest::Approx(100 * (1 - 1 / number(row.at("gain_paid")))).epsilon(1e-3));
  }
  CHECK(rows[0].at("paths") == rows[1].at("paths"));
  CHECK(contains(squeezed(run.out), fmt::format("| H3DH | {:.2f} | ", number(rows[1].at("gain_unpaid")))));
}

TEST_CASE("coherence-rays and coherence-frames: table, plot and paragraph agree") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  for (const std::string name : {"coherence-rays", "coherence-frames"}) {
    CAPTURE(name);
    const bool frames = name == "coherence-frames";
    const Outcome run = run_program({"thesis", name, "-c", file, "-o", folder.path("out")});
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto rows = table(folder.path("out/" + name + ".csv"));
    REQUIRE(rows.size() == (frames ? 2 * 200 * 3 : 3 * 2 * 1000));  // two depths, and whole outputs
    const std::string report = contents(folder.path("out/" + name + ".md"));
    std::map<std::string, std::string> first_of_last;  // rows of coherence-frames, by depth
    for (const auto& row : rows) {
      CHECK(number(row.at("same_surface")) >= 0);
      CHECK(number(row.at("same_surface")) <= 1);
      CHECK(number(row.at("pairs")) > 0);
      if (frames && row.at("frame") == "200" && row.at("against") == "first")
        first_of_last[row.at("depth")] = row.at("total");
    }
    if (frames)
      CHECK(contains(squeezed(report),
                     fmt::format("| last frame with the first, points paired by ray and bounce | {:.2f} | {:.2f} |",
                                 number(first_of_last.at("1")), number(first_of_last.at("2")))));
    else
      CHECK(contains(squeezed(report), fmt::format("| hit points correlate, hilbert | {:.2f} | {:.2f} |",
                                                   number(rows[0].at("points")), number(rows[1000].at("points")))));
    CHECK(contains(report, run.out.substr(0, run.out.find("\n\nwritten"))));
    if (contains(run.err, "gnuplot is not installed")) continue;
    const std::string plot = contents(folder.path("out/" + name + ".svg"));
    CHECK(contains(plot, "</svg>"));
    CHECK(occurrences(plot, "id=\"gnuplot_plot_") == (frames ? 4 : 6) * 2);  // a line per panel and depth
  }
}

TEST_CASE("an interrupt ends the measuring after the point in progress, with whole files and exit code 130") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  Gate gate;
  Program run({"thesis", "figure-6.18", "-c", file, "-o", folder.path("out")}, gate.at_launches());
  while (!contains(run.messages(), "2,000 rays, tracing") && !run.ended()) gate.let_launch(50, run);
  run.signal(SIGINT);
  wait_until_interrupted(run.id());
  gate.open();
  const Outcome outcome = run.wait();
  CAPTURE(outcome.err);
  CHECK(outcome.code == 130);
  CHECK(contains(outcome.err, "interrupted after "));
  const auto rows = table(folder.path("out/figure-6.18.csv"));
  CHECK(rows.size() >= 2 * 6);
  CHECK(rows.size() < 14 * 6);
  CHECK(rows.size() % 6 == 0);
  CHECK(contains(contents(folder.path("out/figure-6.18.md")), "- command: `"));
}

TEST_CASE("figure-6.12: the first setting has no error, and so has a cache with exact keys") {
  if (!device_present()) return;
  const Folder folder;
  // So many rays that some of the spheres of the thesis' world are passed.
  const Outcome run = run_program({"thesis", "figure-6.12", "-o", folder.path("out"), "--rays", "49000:49000",
                                   "--frames", "2", "--set", "trace.max_depth=2"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const auto rows = table(folder.path("out/figure-6.12.csv"));
  REQUIRE(rows.size() == 3 * 10);
  for (const auto& row : rows) {
    CAPTURE(row.at("drive"));
    CAPTURE(row.at("setting"));
    CHECK(row.at("frames") == "2");
    CHECK(number(row.at("warm_s")) > 0);
    CHECK(number(row.at("paths")) > 0);
    if (row.at("setting") == "no cache") CHECK(number(row.at("saved_percent")) == 0);
    if (row.at("setting") != "no cache" && row.at("setting") != "concurrent exact") continue;
    CHECK(number(row.at("lost_share")) == 0);
    CHECK(number(row.at("spurious_share")) == 0);
  }
  CHECK_FALSE(contains(run.err, "gnuplot failed"));
}
