// SPDX-License-Identifier: Apache-2.0
// The table of interactions against what is written by hand beside it: the documents, the drawing program and the
// Python package. The page of the viewer has no names of its own.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "contains.hpp"
#include "folders.hpp"
#include "output/reader.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/interaction_kinds.hpp"

using namespace wavetracer;
using test::slurp;

namespace {

const std::filesystem::path source = test::source_folder();

// Returns the text with each run of spaces and line breaks as one space.
std::string flowing(const std::string& file) {
  return std::regex_replace(slurp(source / file), std::regex("\\s+"), " ");
}

}  // namespace

TEST_CASE("codes, steps and names of interactions are distinct, and those in files are the ones of earlier versions") {
  std::set<uint32_t> codes, steps;
  std::set<std::string_view> words, kinds;
  for (const InteractionKind& kind : interaction_kinds) {
    CHECK(codes.insert(kind.code).second);
    CHECK(steps.insert(kind.step).second);
    CHECK(words.insert(kind.word).second);
    CHECK(kinds.insert(kind.paths.word).second);
    CHECK((WT_STEP_CODES >> 8 * kind.step & 0xFF) == kind.code);
    REQUIRE(find_interaction(kind.code) != nullptr);
    CHECK(find_interaction(kind.code)->word == kind.word);
  }
  for (const uint8_t none : std::to_array<uint8_t>({0, 3, 255})) CHECK(find_interaction(none) == nullptr);
  CHECK(interaction_legend().starts_with("1 reflection, 2 diffuse scattering, 4 transmission, 8 diffraction"));
  CHECK(path_kinds.front().word == "line_of_sight");
  CHECK(std::ranges::find(interaction_kinds, WaypointKind::reflection, &InteractionKind::waypoint)->word ==
        "reflection");
  CHECK(std::ranges::find(interaction_kinds, WaypointKind::diffraction, &InteractionKind::waypoint)->word ==
        "diffraction");
}

TEST_CASE("the documents have the legend of the table") {
  CHECK(contains(flowing("docs/formats.md"), "| interactions | " + interaction_legend() + ","));
}

TEST_CASE("what the drawing program marks are interactions of these numbers and names") {
  const std::string program = slurp(source / "docs/draw_paths.py");
  CHECK(contains(program, "\nREFLECTION = " + std::to_string(reflection) + "\n"));
  const std::regex mark("(\\d+): \\(\"([a-z]+)\", \"m");
  size_t marks = 0;
  for (auto found = std::sregex_iterator(program.begin(), program.end(), mark); found != std::sregex_iterator();
       ++found) {
    ++marks;
    const InteractionKind* kind = find_interaction(static_cast<uint8_t>(std::stoi((*found)[1])));
    REQUIRE(kind != nullptr);
    CHECK(kind->word == (*found)[2].str());
  }
  CHECK(marks + 1 == interaction_kinds.size());
}

TEST_CASE("the Python package has the words of paths and their codes, in the order of the table") {
  std::string words = "KINDS = {\"line_of_sight\": 0";
  for (const InteractionKind& kind : interaction_kinds)
    words += ", \"" + std::string(kind.paths.word) + "\": " + std::to_string(kind.code);
  CHECK(contains(flowing("python/wavetracer/paths.py"), words + "}"));
}

TEST_CASE("the page of the viewer names no kind of path itself") {
  for (const auto& entry : std::filesystem::directory_iterator(source / "host/viewer/page")) {
    CAPTURE(entry.path());
    const std::string text = slurp(entry.path());
    for (const PathKind& kind : path_kinds)
      if (kind.word != "line_of_sight") CHECK_FALSE(contains(text, kind.word));
  }
}
