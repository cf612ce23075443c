// SPDX-License-Identifier: Apache-2.0
// Keys with choices, and keys for which 0 or a word means "not set": every word of every key is read, kept and written
// back unchanged.
#include <doctest/doctest.h>

#include <string>

#include "config/field_table.hpp"
#include "config/texts.hpp"
#include "config/values.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using test::ends;

namespace {

// Assigns TOML text to the field of a Config of defaults, and returns what the field then is as TOML; or the message.
std::string after(const config::Field& field, const std::string& toml) {
  Config c = config::prototype();
  const auto table = toml::parse("value = " + toml);
  const std::string problem = config::assign(field, "key", field.slot(c, 0), *table.get("value"), "/");
  return problem.empty() ? config::literal(field, field.slot(c, 0)) : problem;
}

}  // namespace

TEST_CASE("a choice is one of its words, and says so of any other") {
  static_assert(CacheKind("open") == CacheKind("open"));
  static_assert(CacheKind("open") != CacheKind("chained"));
  static_assert(CacheKind() == "none");
  CHECK(CacheKind::parse("concurrent")->word() == "concurrent");
  CHECK_FALSE(CacheKind::parse("Concurrent").has_value());
  CHECK_FALSE(CacheKind::parse("").has_value());
  CHECK(MountRole::named("both") == MountRole("both"));
  CHECK_THROWS_WITH_AS(MountRole::named("neither"), "\"neither\" is none of transmitter, receiver, both", ConfigError);
}

TEST_CASE("every word of every key with choices is read and written again") {
  size_t keys = 0, words = 0;
  for (const auto& table : config::tables())
    for (const auto& field : table.fields) {
      Config c = config::prototype();
      const config::Slot slot = field.slot(c, 0);
      if (!std::holds_alternative<config::ChoiceSlot>(slot)) continue;
      CAPTURE(table.name);
      CAPTURE(field.name);
      ++keys;
      CHECK(field.choices.size() == std::get<config::ChoiceSlot>(slot).words.size());
      for (const std::string& word : field.choices) {
        ++words;
        CHECK(after(field, "\"" + word + "\"") == "\"" + word + "\"");
      }
      CHECK(after(field, "\"qqqqqqqq\"").find("is not a known value: it must be one of \"") != std::string::npos);
      CHECK(after(field, "1").find("must be one of \"") != std::string::npos);
    }
  CHECK(keys >= 16);
  CHECK(words >= 50);
}

TEST_CASE("0 and auto leave an optional unset, are written again, and are no number") {
  size_t keys = 0;
  for (const auto& table : config::tables())
    for (const auto& field : table.fields) {
      if (field.none.empty()) continue;
      CAPTURE(table.name);
      CAPTURE(field.name);
      ++keys;
      Config c = config::prototype();
      const bool real = std::holds_alternative<std::optional<double>*>(field.slot(c, 0));
      if (field.none == "0") {
        CHECK(after(field, "0") == (real ? "0.0" : "0"));
        CHECK(after(field, "0.0") == (real ? "0.0" : "0"));
        CHECK(after(field, "-1").find("out of range") != std::string::npos);
      } else {
        CHECK(after(field, "\"" + field.none + "\"") == "\"" + field.none + "\"");
        if (field.range.lower > 0 || field.range.lower_open)
          CHECK(after(field, "0").find("out of range") != std::string::npos);
        else
          CHECK(after(field, "0") == (real ? "0.0" : "0"));  // a number like any other
      }
      const std::string inside = field.range.lower > 2 ? "50" : "2";
      CHECK(after(field, inside) == inside + (real ? ".0" : ""));
      CHECK(after(field, "\"never\"").find("must be") != std::string::npos);
    }
  CHECK(keys == 15);
}

TEST_CASE("a configuration is echoed as it was given: mnemonics, 0 and auto") {
  const Config c = parse_config(
      "scene.file = \"/s.xml\"\norder.method = \"H3DH\"\ntrace.refresh_rays = 0\ntime.step_s = 0\n" + ends, "a.toml");
  CHECK(c.order.method == OrderMethod("H3DH"));
  CHECK_FALSE(c.trace.refresh_rays.has_value());
  CHECK_FALSE(c.time.step_s.has_value());
  const std::string text = resolved_config(c);
  for (const char* line :
       {"\nmethod = \"H3DH\"\n", "\nrefresh_rays = 0\n", "\nstep_s = 0.0\n", "\nidle_timeout_s = 300.0\n"})
    CHECK(text.find(line) != std::string::npos);
}
