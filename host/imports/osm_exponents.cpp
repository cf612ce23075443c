// SPDX-License-Identifier: Apache-2.0
// Searches for the names of the two attributes, since the text is long and exponents are rare.
#include "imports/osm_exponents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "imports/city_model.hpp"
#include "imports/map.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// Returns the value of an attribute from the text after its name; empty if there is none.
std::string_view value_after(std::string_view text) {
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size())); };
  skip_blanks();
  if (!text.starts_with('=')) return {};
  text.remove_prefix(1);
  skip_blanks();
  if (!text.starts_with('"') && !text.starts_with('\'')) return {};
  const size_t end = text.find(text[0], 1);
  return end == text.npos ? text.substr(1) : text.substr(1, end - 1);
}

bool is_out_of_bounds(std::string_view value) {
  const size_t exponent = value.find_first_of("eE");
  if (exponent == value.npos || value.substr(exponent + 1).starts_with('-')) return false;
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc::result_out_of_range || (error == std::errc() && std::abs(number) >= 1e9);
}

}  // namespace

void check_exponents(std::string_view content, const std::string& name) {
  for (const std::string_view key : {"lat", "lon"})
    for (size_t at = content.find(key, 1); at != content.npos; at = content.find(key, at + key.size())) {
      if (blanks.find(content[at - 1]) == blanks.npos) continue;
      const std::string_view value = value_after(content.substr(at + key.size(), 200));
      if (is_out_of_bounds(value))
        throw InputError(fmt::format("{}: {} is '{}', which is no place on the globe",
                                     line_of(content, static_cast<std::ptrdiff_t>(at), name), key, printable(value)));
    }
}

}  // namespace wavetracer::imports
