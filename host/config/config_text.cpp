// SPDX-License-Identifier: Apache-2.0
// Makes texts from the field table: the commented config of `init`, the key list of `--help`, the resolved config. A
// table without brackets of its own must follow the one before it, as TOML reads it.
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include "config/field_table.hpp"
#include "config/reference.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer {
namespace {

using namespace config;

// Breaks text at spaces so that no line is longer than 100 characters; each line starts with `lead`.
std::string wrapped(const std::string& text, const std::string& lead) {
  std::string out, line;
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!line.empty() && lead.size() + line.size() + 1 + word.size() > 100) {
      out += lead + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    start = end + 1;
  }
  return out + lead + line + "\n";
}

// Returns type, range and default, in one sentence.
std::string facts(const Field& field) {
  Config defaults = prototype();
  const std::string value = literal(field, field.slot(defaults, 0));
  std::string out = accepted(field);
  out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  out += field.required                                      ? "; " + required_text(field) + "."
         : value.empty() || value == "\"\"" || value == "{}" ? "."
                                                             : "; default " + value + ".";
  return out;
}

std::string header(const Table& table) { return table.append ? "[[" + table.name + "]]" : "[" + table.name + "]"; }

}  // namespace

std::string commented_config() {
  std::string out = "# A wavetracer configuration with every key: what it means, its range and its default.\n";
  Config defaults = prototype();
  for (const Table& table : tables()) {
    const std::string off = table.optional ? "# " : "";
    out += "\n" + wrapped(table.doc, "# ") + off + header(table) + "\n";
    for (const Field& field : table.fields) {
      out += wrapped(field.doc, "# ") + wrapped(facts(field), "# ");
      const std::string value = literal(field, field.slot(defaults, 0));
      const bool active = field.example.empty() ? !value.empty() && value != "\"\"" : field.required || field.needed;
      const std::string& shown = field.example.empty() ? value : field.example;
      out += (off.empty() && !active ? "# " : off) + field.name + " = " + shown + "\n";
    }
  }
  return out;
}

std::string field_help(std::string_view topic) {
  std::string out;
  for (const Table& table : tables()) {
    std::string keys;
    const bool whole = topic.empty() || topic == table.name;
    for (const Field& field : table.fields)
      if (const std::string key = table.name + "." + field.name; whole || topic == key || topic == field.name)
        keys += "  " + key + "\n" + wrapped(field.doc, "      ") + wrapped(facts(field), "      ");
    if (whole || !keys.empty()) out += (out.empty() ? "" : "\n") + header(table) + "  " + table.doc + "\n" + keys;
  }
  return out;
}

namespace {

// which: tells for a table and a field whether the text has it.
template <typename Which>
std::string text_of(const Config& config, const Which& which) {
  std::string out;
  Config values = config;  // a copy, since slots point to values that may be written
  const auto write = [&](const Table& table, size_t element) {
    out += (out.empty() ? "" : "\n") + header(table) + "\n";
    for (const Field& field : table.fields) {
      const std::string value = literal(field, field.slot(values, element));
      if (!value.empty() && which(table, field) && !replaced(table, field, values, element))
        out += field.name + " = " + value + "\n";
    }
  };
  for (const Table& table : tables()) {
    if (!table.append) {
      write(table, 0);
      continue;
    }
    const size_t count = table.count(values);
    for (size_t i = 0; i < count; ++i) write(table, i);
  }
  return out;
}

}  // namespace

std::string resolved_config(const Config& config) {
  return text_of(config, [](const Table&, const Field&) { return true; });
}

std::string echoed_config(const Config& config) {
  return text_of(config, [&](const Table& table, const Field& field) {
    return table.name != "output" ||
           (field.name != "directory" && field.name != "keep_shards" && field.name != "compression" &&
            (field.name != "shard_frames" || config.trace.reuse));
  });
}

}  // namespace wavetracer
