// SPDX-License-Identifier: Apache-2.0
// The layers of [[material]]: what is read, written again and refused.
#include <doctest/doctest.h>

#include <cmath>

#include "config/texts.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string with_layers(const std::string& layers, const std::string& more = "") {
  return "scene.file = \"/s.xml\"\n[[material]]\nname = \"facade\"\nlayers = " + layers + "\n" + more + ends;
}

}  // namespace

TEST_CASE("layers are read in their order, as inline tables and as tables of their own, and written again") {
  const Config c = parse_config(
      with_layers("[{ material = \"brick\", thickness_m = 0.12 }, { thickness_m = inf, material = \"wood\" }]"),
      "a.toml");
  REQUIRE(c.materials.size() == 1);
  REQUIRE(c.materials[0].layers.size() == 2);
  CHECK(c.materials[0].layers[0] == LayerConfig{"brick", 0.12});
  CHECK(c.materials[0].layers[1].material == "wood");
  CHECK(std::isinf(c.materials[0].layers[1].thickness_m));
  const Config again = parse_config(resolved_config(c), "b.toml");
  CHECK(again.materials.at(0).layers == c.materials[0].layers);
  const Config apart = parse_config(
      "scene.file = \"/s.xml\"\n[[material]]\nname = \"facade\"\n"
      "[[material.layers]]\nmaterial = \"brick\"\nthickness_m = 1\n" +
          ends,
      "c.toml");
  CHECK(apart.materials.at(0).layers == std::vector<LayerConfig>{{"brick", 1}});
  const Config set = parse_config(with_layers("[{ material = \"brick\", thickness_m = 1 }]"), "d.toml",
                                  {"material.0.layers=[{ material = \"wood\", thickness_m = 2 }]"});
  CHECK(set.materials.at(0).layers == std::vector<LayerConfig>{{"wood", 2}});
}

TEST_CASE("wrong layers get a message with their place") {
  const auto refused = [](const std::string& layers, const std::string& message, const std::string& more = "") {
    CAPTURE(layers);
    const std::string found = error_of(with_layers(layers, more));
    CAPTURE(found);
    CHECK(found.find(message) != std::string::npos);
  };
  refused("[]", ":4:10: material.layers is empty: give at least one layer");
  refused("3", "material.layers must be an array of 1 to 8 tables with material and thickness_m, not an integer");
  refused("[3]", "material.layers[0] must be a table with material and thickness_m, not an integer");
  refused("[{ material = \"brick\" }]", "material.layers[0] has no thickness_m");
  refused("[{ thickness_m = 1 }]", "material.layers[0] has no material");
  refused("[{ material = \"a\", thickness = 1 }]", "material.layers[0] has an unknown key \"thickness\"");
  refused("[{ material = 1, thickness_m = 1 }]", "material.layers[0].material must be a string, not an integer");
  refused("[{ material = \"\", thickness_m = 1 }]", "material.layers[0].material is empty");
  refused("[{ material = \"a\", thickness_m = \"b\" }]", "material.layers[0].thickness_m must be a number");
  refused("[{ material = \"a\", thickness_m = 1 }, { material = \"a\", thickness_m = -0.1 }]",
          "material.layers[1].thickness_m = -0.1 is out of range: it must be a number above 0 up to inf");
  const std::string layer = "{ material = \"a\", thickness_m = 1 }";
  std::string nine = "[" + layer;
  for (int i = 1; i < 9; ++i) nine += ", " + layer;
  refused(nine + "]", "material.layers has 9 layers: a wall may have 8 at most");
  for (const std::string key : {"a", "b", "c", "d", "permittivity", "conductivity_s_m", "thickness_m"})
    refused("[" + layer + "]", "[[material]] has both layers and " + key + ": remove " + key, key + " = 2\n");
  refused("[" + layer + "]", "[[material]] has both layers and library", "library = \"wood\"\n");
  refused("[" + layer + "]", "[[material]] has both layers and vegetation", "vegetation = \"mixed\"\n");
}
