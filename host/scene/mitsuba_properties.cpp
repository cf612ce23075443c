// SPDX-License-Identifier: Apache-2.0
// The tags are those of Mitsuba 3.5 (src/core/xml.cpp).
#include "scene/mitsuba_properties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "base/spelling.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

bool is_mitsuba_property(pugi::xml_node node) {
  static constexpr std::array<std::string_view, 9> tags = {"boolean", "integer", "float",    "string",   "point",
                                                           "vector",  "rgb",     "spectrum", "transform"};
  return std::ranges::find(tags, std::string_view(node.name())) != tags.end();
}

void check_properties(const MitsubaFiles& files, pugi::xml_node node, const std::vector<std::string>& known,
                      const std::vector<std::string_view>& objects) {
  std::set<std::string> seen;
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    if (!is_mitsuba_property(child)) {
      if (std::ranges::find(objects, std::string_view(child.name())) != objects.end()) continue;
      files.fail(child, fmt::format(" is not known inside of {}", MitsubaFiles::describe(node)));
    }
    const std::string name = child.attribute("name").value();
    if (std::ranges::find(known, name) == known.end()) {
      const bool old = std::ranges::any_of(name, [](char c) { return c >= 'A' && c <= 'Z'; });
      files.fail(child, fmt::format(": {} has no property '{}'{}; known: {}{}", MitsubaFiles::describe(node), name,
                                    spelling_hint(name, known), fmt::join(known, ", "),
                                    old ? ". Names with capitals are those of Mitsuba before 2.0: a file of that time "
                                          "begins with <scene version=\"0.6.0\">"
                                        : ""));
    }
    if (!seen.insert(name).second)
      files.fail(child, fmt::format(": {} has the property '{}' twice", MitsubaFiles::describe(node), name));
  }
}

pugi::xml_node mitsuba_property(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                std::initializer_list<std::string_view> tags) {
  for (const pugi::xml_node child : node.children()) {
    if (child.attribute("name").value() != name || !is_mitsuba_property(child)) continue;
    if (std::ranges::find(tags, std::string_view(child.name())) == tags.end())
      files.fail(child, fmt::format(": {} of {} must be a <{}>", name, MitsubaFiles::describe(node),
                                    fmt::join(tags, "> or <")));
    return child;
  }
  return {};
}

std::optional<double> mitsuba_number(const MitsubaFiles& files, pugi::xml_node node, std::string_view name,
                                     double least, bool infinite) {
  const pugi::xml_node child = mitsuba_property(files, node, name, {"float", "integer"});
  if (!child) return std::nullopt;
  files.check_attributes(child, {"name", "value"});
  const std::string text = files.attribute(child, "value");
  const size_t last = text.find_last_not_of(" \t\r\n") + 1;  // 0 if there are only blanks, or nothing
  const size_t first = std::min(text.find_first_not_of(" \t\r\n"), last);
  const char* const end = text.data() + last;
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data() + first, end, value);
  if (error != std::errc() || stop != end || !(value >= least) || (!infinite && std::isinf(value))) {
    throw InputError(fmt::format("{}: {}: {} = '{}' must be a number of at least {}", files.where(child),
                                 MitsubaFiles::describe(node), name, text, least));
  }
  return value;
}

}  // namespace wavetracer
