// SPDX-License-Identifier: Apache-2.0
// Tests figures of caches as `wavetracer thesis` draws them: their tables must agree with the words and with
// themselves. Cases that need a device are skipped with a message if there is none.
#include <doctest/doctest.h>
#include <map>
#include "study/experiment_program.hpp"
#include "study/squeezed.hpp"

using namespace experiment_program;

TEST_CASE("figure-6.3: writes and reads of entries along the buffer; tracing, hash and calls have one time") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", street);
  const Outcome run = run_program({"thesis", "figure-6.3", "-c", file, "-o", folder.path("out"), "--repeat", "1"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  std::map<std::string, std::map<std::string, size_t>> counts;  // by setting and operation
  std::map<std::string, double> trace_ns;
  for (const auto& row : table(folder.path("out/figure-6.3.csv"))) {
    const std::string &setting = row.at("setting"), &operation = row.at("operation");
    CAPTURE(setting);
    CAPTURE(operation);
    ++counts[setting][operation];
    CHECK(row.at("drive") == "still");
    CHECK(number(row.at("slot")) < 50000);
    CHECK(number(row.at("ns")) > 0);
    const bool of_entry = operation == "write" || operation == "read";
    CHECK((number(row.at("cycles")) > 0) == of_entry);
    if (operation == "read") CHECK(number(row.at("hits")) > 0);
    if (operation == "trace") trace_ns[setting] = number(row.at("ns"));
  }
  CHECK(counts.size() == 6);  // ours and those printed in the thesis
  const std::string text = squeezed(run.out);
  for (auto& [setting, operations] : counts) {
    CAPTURE(setting);
    CHECK(operations["write"] == 400);
    CHECK(operations["read"] > 10);
    CHECK(operations["trace"] == 2);
    // The last cell of the report's row.
    const size_t at = text.find("| " + setting + " | ");
    REQUIRE(at != std::string::npos);
    const std::string line = text.substr(at, text.find(" |\n", at) - at);
    CHECK(number(line.substr(line.rfind("| ") + 2)) == doctest::Approx(trace_ns[setting]).epsilon(0.006));
  }
  check_error({"thesis", "figure-6.2", "-c", file, "-o", folder.path("out"), "--rays", "1000:2000"}, 2,
              "launches 50,000 rays; leave --rays out");
}
