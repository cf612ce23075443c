// SPDX-License-Identifier: Apache-2.0
// Tests figures of caches as `wavetracer thesis` draws them: their tables must agree with the words and with
// themselves. Cases that need a device are skipped with a message if there is none.
#include <doctest/doctest.h>
#include <map>
#include "study/experiment_program.hpp"
#include "study/squeezed.hpp"

using namespace experiment_program;

TEST_CASE("figure-6.3: a row per depth and setting; times, counts and the paragraph agree") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"thesis", "figure-6.3", "-c", file, "-o", folder.path("out"), "--repeat", "1"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const auto rows = table(folder.path("out/figure-6.3.csv"));
  // Ours and those printed in the thesis, at all depths together, depth 1 and depth 2; their counted twins together.
  REQUIRE(rows.size() == 7 * 3 + 6);
  for (const auto& row : rows) {
    CAPTURE(row.at("setting"));
    CHECK(row.at("rays") == "50000");
    CHECK(row.at("drive") == "still");
    const bool cached = row.at("setting") != "no cache";
    if (row.at("depth") == "1") CHECK(row.at("segments") == "50000");
    if (!cached || row.at("depth") != "0") continue;
    CHECK(row.at("entries") == "50000");
    CHECK(number(row.at("lookups")) == number(row.at("segments")));
    CHECK(number(row.at("write_ns")) > 0);
    CHECK(number(row.at("read_ns")) > 0);
    if (row.at("setting").ends_with(" counted")) continue;
    const std::string text = squeezed(run.out);
    const size_t at = text.find("| " + row.at("setting") + " | ");
    REQUIRE(at != std::string::npos);
    const std::string cells = text.substr(at + row.at("setting").size() + 5);
    CHECK(number(cells) == doctest::Approx(number(row.at("write_ns"))).epsilon(0.006));
    CHECK(number(cells.substr(cells.find('|') + 1)) == doctest::Approx(number(row.at("read_ns"))).epsilon(0.006));
  }
}

TEST_CASE("figure-6.2: cycles by the depth of an entry in its bucket's tree, whose entries are those of the table") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"thesis", "figure-6.2", "-c", file, "-o", folder.path("out"), "--repeat", "1"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  std::map<std::string, double> entries;
  for (const auto& row : table(folder.path("out/figure-6.2.csv"))) {
    CAPTURE(row.at("setting"));
    CHECK(number(row.at("tree_depth")) >= 1);
    CHECK(number(row.at("write_cycles")) > 0);
    entries[row.at("setting")] += number(row.at("entries"));
  }
  CHECK(entries.size() == 6);
  for (const auto& [setting, count] : entries) {
    CAPTURE(setting);
    CHECK(count > 1000);
    CHECK(count <= 50000);
  }
  check_error({"thesis", "figure-6.2", "-c", file, "-o", folder.path("out"), "--rays", "1000:2000"}, 2,
              "launches 50,000 rays; leave --rays out");
}
