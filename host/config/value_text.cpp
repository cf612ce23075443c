// SPDX-License-Identifier: Apache-2.0
// Writes values of the field table as text: TOML literals, and descriptions of what a field accepts.
#include "config/value_text.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "config/field_table.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer::config {
namespace {

std::string short_number(double x) { return std::isinf(x) ? "inf" : fmt::format("{:.10g}", x); }

std::string ranged(std::string_view noun, const Range& r) {
  std::string out(noun);
  const double largest = std::numeric_limits<double>::max();
  if (r.lower > -largest) out += (r.lower_open ? " above " : " from ") + short_number(r.lower);
  if (r.upper < largest || std::isinf(r.upper)) out += (r.lower_open ? " up to " : " to ") + short_number(r.upper);
  return out;
}

}  // namespace

std::string number_text(double x) {
  if (std::isinf(x)) return x < 0 ? "-inf" : "inf";
  std::string text = fmt::format("{}", x);  // the shortest text that reads back as x
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string literal(const Field& field, const Slot& slot) {
  const auto none = [&](const char* zero) {
    return field.none.empty() ? "" : field.none == "0" ? zero : toml_string(field.none);
  };
  const auto list = [](const auto& elements, const auto& text) {
    std::string out = "[";
    for (const auto& element : elements) out += (out.size() > 1 ? ", " : "") + text(element);
    return out + "]";
  };
  return std::visit(
      Overload{
          [](const std::string* s) { return toml_string(*s); },
          [](const bool* b) { return std::string(*b ? "true" : "false"); },
          [](const double* x) { return number_text(*x); },
          [&](const std::optional<double>* x) { return *x ? number_text(**x) : none("0.0"); },
          [](const ChoiceSlot& choice) { return toml_string(choice.words[choice.chosen->value]); },
          [&](const std::array<double, 3>* v) { return list(*v, number_text); },
          [&](const std::optional<std::array<double, 2>>* v) { return *v ? list(**v, number_text) : std::string(); },
          [&](const std::optional<std::array<double, 3>>* v) { return *v ? list(**v, number_text) : std::string(); },
          [&](const std::vector<std::string>* words) { return list(*words, toml_string); },
          [&](const std::vector<double>* numbers) { return list(*numbers, number_text); },
          [&]<size_t N>(const std::vector<std::array<double, N>>* rows) {
            return list(*rows, [&](const auto& row) { return list(row, number_text); });
          },
          [&](const std::vector<LayerConfig>* layers) {
            return layers->empty() ? "" : list(*layers, [](const LayerConfig& layer) {
              return fmt::format("{{ material = {}, thickness_m = {} }}", toml_string(layer.material),
                                 number_text(layer.thickness_m));
            });
          },
          [](const Aliases* aliases) {
            std::string out;
            for (const auto& [from, to] : *aliases)
              out += fmt::format("{}{} = {}", out.empty() ? "{ " : ", ", toml_string(from), toml_string(to));
            return out.empty() ? "{}" : out + " }";
          },
          [&]<class T>(const T* i) {
            if constexpr (Number<T>::optional)
              return *i ? fmt::format("{}", **i) : none("0");
            else
              return fmt::format("{}", *i);
          },
      },
      slot);
}

bool replaced(const Table& table, const Field& field, Config& config, size_t element) {
  const auto other =
      std::find_if(table.fields.begin(), table.fields.end(), [&](const Field& f) { return f.name == field.instead; });
  if (field.instead.empty() || other == table.fields.end()) return false;
  const std::string value = literal(*other, other->slot(config, element));
  return !value.empty() && value != "[]";
}

std::string required_text(const Field& field) {
  return field.instead.empty() ? "required" : "required, or `" + field.instead + "`";
}

std::string number_of(const Range& range) {
  const std::string out = ranged("a number", range);
  return out == "a number" ? "a finite number" : out;
}

std::string accepted(const Field& field) {
  Config sample = prototype();
  const std::string unit = field.unit.empty() ? "" : " (" + field.unit + ")";
  const auto range = [&](std::string_view noun) { return ranged(noun, field.range) + unit; };
  std::string choices;
  for (const std::string& choice : field.choices) choices += (choices.empty() ? "" : ", ") + toml_string(choice);
  return std::visit(
      Overload{
          [&](const std::string*) -> std::string {
            if (field.form == Form::choice_or_file) return choices + " or the path of a file";
            if (field.form == Form::input_file) return "the path of a file";
            return field.form == Form::output_folder ? "the path of a folder" : "a string";
          },
          [&](const ChoiceSlot&) -> std::string { return "one of " + choices; },
          [&](const bool*) -> std::string { return "true or false"; },
          [&](const std::array<double, 3>*) -> std::string { return range("three numbers"); },
          [&](const std::optional<std::array<double, 2>>*) -> std::string { return range("two numbers"); },
          [&](const std::optional<std::array<double, 3>>*) -> std::string { return range("three numbers"); },
          [&](const Aliases*) -> std::string { return "a table of strings"; },
          [&](const std::vector<std::string>*) -> std::string { return "a string or an array of strings"; },
          [&](const std::vector<LayerConfig>*) -> std::string {
            return fmt::format("an array of 1 to {} tables with material and thickness_m", most_layers);
          },
          [&](const std::vector<double>*) -> std::string { return range("an array of numbers"); },
          [&](const std::vector<std::array<double, 3>>*) -> std::string { return range("an array of [x, y, z]"); },
          [&](const std::vector<std::array<double, 4>>*) -> std::string {
            return range(field.name == "waypoints" ? "an array of [time, x, y, z]" : "an array of four numbers each");
          },
          [&](const std::vector<std::array<double, 7>>*) -> std::string {
            return range("an array of seven numbers each");
          },
          [&]<class T>(const T*) -> std::string {
            return range(is_integer<T> ? "an integer" : "a number") + (choices.empty() ? "" : " or " + choices);
          },
      },
      field.slot(sample, 0));
}

}  // namespace wavetracer::config
