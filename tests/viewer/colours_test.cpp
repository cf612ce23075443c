// SPDX-License-Identifier: Apache-2.0
// Colours that the page has in its scripts are those of plots and pictures.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include "coverage/png.hpp"
#include "plots/figure.hpp"
#include "viewer/page_files.hpp"

using namespace wavetracer;

TEST_CASE("page and plots have one scale of colours") {
  const auto colours = [](std::string_view text) {
    std::vector<std::string> out;
    for (size_t at = 0; (at = text.find('#', at)) != std::string_view::npos; ++at) out.emplace_back(text.substr(at, 7));
    return out;
  };
  const std::string_view page = page_file("palette.js"), begin = "const viridis = [";
  const size_t from = page.find(begin);
  REQUIRE(from != std::string_view::npos);
  CHECK(colours(page.substr(from, page.find(']', from) - from)) == colours(plots::palette()));
  CHECK(colours(plots::palette()).size() == 10);
  std::string servers;
  for (const Colour& c : coverage::server_colours) servers += fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
  const size_t list = page.find("const server_colours = [");
  REQUIRE(list != std::string_view::npos);
  CHECK(colours(page.substr(list, page.find(']', list) - list)) == colours(servers));
}
