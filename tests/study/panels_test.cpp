// SPDX-License-Identifier: Apache-2.0
// Tests the layout of plots: blocks of lines that can be told apart, and places that do not overlap.
#include "study/panels.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <cstdlib>
#include "contains.hpp"
#include "study/cache_study.hpp"
#include "study/experiment.hpp"

using namespace wavetracer::study;

namespace {

using Blocks = std::vector<std::vector<std::string>>;

// Returns the number behind the last of these words.
double number_after(const std::string& text, const std::string& words) {
  return std::strtod(text.c_str() + text.rfind(words) + words.size(), nullptr);
}

}  // namespace

TEST_CASE("few settings are one block; of many, tables as printed are another, with the same reference") {
  CHECK(line_blocks({"no cache", "a", "printed a"}) == Blocks{{"no cache", "a", "printed a"}});
  CHECK(line_blocks({"no cache", "a", "b", "c", "d", "printed a", "printed b", "printed c", "printed d"}) ==
        Blocks{{"no cache", "a", "b", "c", "d"}, {"no cache", "printed a", "printed b", "printed c", "printed d"}});
  CHECK(line_blocks({"a", "b", "c", "d", "e", "f", "g", "h", "i"}) ==
        Blocks{{"a", "b", "c", "d"}, {"e", "f", "g", "h", "i"}});
}

TEST_CASE("no block of any study has more lines than there are colours, and none is lost") {
  for (const Experiment& experiment : experiments()) {
    if (!experiment.study()) continue;
    CAPTURE(experiment.name);
    std::vector<std::string> settings;
    for (const Setting& setting : experiment.study()->settings)
      if (std::ranges::find(settings, setting.name) == settings.end()) settings.push_back(setting.name);
    std::vector<std::string> drawn;
    for (const std::vector<std::string>& block : line_blocks(settings)) {
      CHECK(block.size() <= most_lines);
      drawn.insert(drawn.end(), block.begin(), block.end());
    }
    for (const std::string& setting : settings) CHECK(std::ranges::find(drawn, setting) != drawn.end());
  }
}

TEST_CASE("panels stand in rows of two, blocks below each other, keys below their blocks") {
  const PanelPage page({5, 3}, 3, 3);
  const auto side = [&](size_t block, size_t panel, const char* which) {
    return number_after(page.margins(block, panel), which + std::string("margin at screen "));
  };
  CHECK(side(0, 0, "l") > 0);
  CHECK(side(0, 0, "r") < side(0, 1, "l"));
  CHECK(side(0, 1, "r") < 1);
  CHECK(side(0, 0, "t") < 1);
  CHECK(side(0, 2, "l") == side(0, 0, "l"));
  CHECK(side(0, 2, "t") < side(0, 0, "b"));
  const double key = number_after(page.key(0), "0.5, ");
  CHECK(key < side(0, 2, "b"));
  CHECK(side(1, 0, "t") < key - 2 * 17 / page.height_px());  // two rows of keys
  CHECK(number_after(page.key(1), "0.5, ") > 0);
  CHECK(contains(page.key(0), "maxrows 2 "));
}
