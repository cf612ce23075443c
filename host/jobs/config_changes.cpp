// SPDX-License-Identifier: Apache-2.0
// Reads only what echoed_config() writes: headings, comments, and KEY = VALUE on a line.
// Values are compared as text, since each value is written in one way only.
#include "jobs/config_changes.hpp"
#include <fmt/format.h>
#include <map>
#include <utility>

namespace wavetracer {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

Entries entries_of(std::string_view text) {
  Entries out;
  std::map<std::string, size_t> elements;
  std::string table;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with("[[")) {
      const std::string name(line.substr(2, line.find(']') - 2));
      table = fmt::format("{}.{}", name, elements[name]++);
    } else if (line.starts_with("[")) {
      table = line.substr(1, line.find(']') - 1);
    } else if (const size_t equals = line.find(" = "); equals != line.npos && !line.starts_with("#")) {
      const std::string_view key = line.substr(0, equals);
      out.emplace_back(table.empty() ? std::string(key) : fmt::format("{}.{}", table, key), line.substr(equals + 3));
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> config_changes(std::string_view was, std::string_view is) {
  const Entries before = entries_of(was), now = entries_of(is);
  std::map<std::string, std::string> old(before.begin(), before.end());
  std::vector<std::string> out;
  for (const auto& [key, value] : now) {
    const auto found = old.find(key);
    if (found == old.end())
      out.push_back(fmt::format("{} was not given and is {}", key, value));
    else if (found->second != value)
      out.push_back(fmt::format("{} was {} and is {}", key, found->second, value));
    if (found != old.end()) old.erase(found);
  }
  for (const auto& [key, value] : before)
    if (old.contains(key)) out.push_back(fmt::format("{} was {} and is not given", key, value));
  return out;
}

}  // namespace wavetracer
