// SPDX-License-Identifier: Apache-2.0
// Makes pages from the field table, one entry per key: accepted values, default, meaning.
// Docs of fields are plain text with at most `code` in them.
#include "config/reference.hpp"
#include <fmt/format.h>
#include <cctype>
#include "config/field_table.hpp"

namespace wavetracer::config {
namespace {

std::string header(const Table& table) { return table.append ? "[[" + table.name + "]]" : "[" + table.name + "]"; }

// Returns the default as TOML, or empty if there is none.
std::string default_of(const Field& field) {
  Config defaults = prototype();
  const std::string value = literal(field, field.slot(defaults, 0));
  return field.required || value == "\"\"" || value == "{}" ? "" : value;
}

// Returns type and range, beginning with a capital letter.
std::string accepts(const Field& field) {
  std::string out = accepted(field);
  out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

// Returns a cell of a table in Markdown. Text between backquotes is code, where only the bar needs an escape.
std::string cell(std::string_view text) {
  std::string out;
  bool code = false;
  for (const char c : text) {
    code ^= c == '`';
    if (c == '|' || (!code && (c == '*' || c == '_' || c == '[' || c == ']' || c == '\\'))) out += '\\';
    if (c == '<' && !code)
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

constexpr const char* how_to_read =
    "A configuration is a TOML file; `wavetracer init` prints one with every key, and it runs as it is. "
    "Tables in double brackets may be given many times, once per element. Any key can be set on the command line, "
    "which overrides the file: `--set trace.rays=1000000`. For an element, give its number: "
    "`--set transmitter.0.antenna=dipole`. A value is TOML, and text that is not valid TOML is a string. "
    "Relative paths in a file start at the folder of the file, those of --set at the current folder. "
    "Unknown keys are errors; the message gives file, line, column and the nearest known key.";

}  // namespace

std::string roff(std::string_view text) {
  std::string out;
  bool bold = false, line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    line_start = c == '\n';
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '"':
        out += "\\(dq";
        break;
      case '`':
        bold = !bold;
        out += bold ? "\\fB" : "\\fR";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string markdown_reference() {
  std::string out = fmt::format(
      "# Configuration\n<!-- Written by `wavetracer documentation --reference`: do not edit. -->\n{}\n", how_to_read);
  for (const Table& table : tables()) {
    out += fmt::format("\n## {}\n{}\n\n| key | accepts | default | meaning |\n| --- | --- | --- | --- |\n",
                       cell(header(table)), cell(table.doc));
    for (const Field& field : table.fields) {
      const std::string value = default_of(field);
      out += fmt::format("| `{}` | {} | {} | {} |\n", field.name, cell(accepts(field)),
                         field.required  ? cell(required_text(field))
                         : value.empty() ? ""
                                         : cell("`" + value + "`"),
                         cell(field.doc));
    }
  }
  return out;
}

std::string manual_page(std::string_view version) {
  std::string out = fmt::format(
      ".TH WAVETRACER.TOML 5 \"\" \"wavetracer {}\" \"File formats\"\n.SH NAME\n"
      "wavetracer.toml \\- configuration of wavetracer\n.SH DESCRIPTION\n{}\n",
      version, roff(how_to_read));
  for (const Table& table : tables()) {
    out += fmt::format(".SH \"{}\"\n{}\n", roff(header(table)), roff(table.doc));
    for (const Field& field : table.fields) {
      const std::string value = default_of(field);
      out += fmt::format(".TP\n.B {}\n{}\n.br\n{}{}\n", roff(field.name), roff(field.doc), roff(accepts(field)),
                         field.required  ? "; " + roff(required_text(field)) + "."
                         : value.empty() ? "."
                                         : "; default " + roff(value) + ".");
    }
  }
  return out + ".SH SEE ALSO\n.BR wavetracer (1)\n";
}

std::vector<std::pair<std::string, std::vector<std::string>>> settable_keys() {
  std::vector<std::pair<std::string, std::vector<std::string>>> out;
  Config sample = prototype();
  for (const Table& table : tables())
    for (const Field& field : table.fields) {
      const bool logical = std::holds_alternative<bool*>(field.slot(sample, 0));
      out.emplace_back(table.name + (table.append ? ".0." : ".") + field.name,
                       logical ? std::vector<std::string>{"true", "false"} : field.choices);
    }
  return out;
}

}  // namespace wavetracer::config
