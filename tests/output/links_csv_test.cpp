// SPDX-License-Identifier: Apache-2.0
// Rows of several links.csv in one, and the proof that they are there.
#include "output/links_csv.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "base/file.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

TEST_CASE("joined rows are proved, and a byte that is wrong, missing or too much is refused") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  std::vector<fs::path> parts;
  for (const int first : {3, 13}) {
    fs::create_directory(folder.path() / std::to_string(first));
    write_outputs(folder.path() / std::to_string(first), sample.run(), sample.drive(first, 10));
    parts.push_back(folder.path() / std::to_string(first) / "links.csv");
  }
  const fs::path joined = folder.path() / "links.csv";
  PendingFile file(joined);
  join_links_csv(parts, file);
  file.sync();
  file.commit();
  CHECK_NOTHROW(prove_links_csv(parts, joined));
  const std::string first = read_file(parts[0]), second = read_file(parts[1]), text = read_file(joined);
  CHECK(text == first + second.substr(second.find('\n') + 1));

  const auto refused = [&](const std::function<void(std::string&)>& change) {
    std::string changed = text;
    change(changed);
    write_file(joined, changed);
    CHECK_THROWS_WITH_AS(prove_links_csv(parts, joined), doctest::Contains("links.csv: does not read back"),
                         RuntimeError);
  };
  refused([](std::string& s) { s[s.size() / 2] ^= 1; });
  refused([](std::string& s) { s[0] = 'T'; });
  refused([](std::string& s) { s.pop_back(); });
  refused([](std::string& s) { s += '\n'; });
  refused([](std::string& s) { s.clear(); });
}
