// SPDX-License-Identifier: Apache-2.0
// Converts between TOML and the members of Config, one function per slot type.
// An integer may be given as a float of integral value (1e6); NaN is never accepted.
#include "config/values.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include "base/spelling.hpp"
#include "config/field_table.hpp"
#include "config/value_text.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer::config {
namespace {

std::string kind_of(const toml::node& value) {
  switch (value.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

std::string unquoted(const toml::node& value) {
  if (const auto* i = value.as_integer()) return fmt::format("{}", i->get());
  if (const auto* x = value.as_floating_point()) return std::isnan(x->get()) ? "nan" : number_text(x->get());
  return kind_of(value);
}

bool inside(double x, const Range& range) {  // false for NaN
  return x <= range.upper && (range.lower_open ? x > range.lower : x >= range.lower);
}

std::string wrong_type(const Field& field, const std::string& key, const toml::node& value) {
  return fmt::format("{} must be {}, not {}", key, accepted(field), kind_of(value));
}

std::string out_of_range(const Field& field, const std::string& key, const toml::node& value) {
  return fmt::format("{} = {} is out of range: it must be {}", key, unquoted(value), accepted(field));
}

// Tells whether the value says that an optional is not set.
bool says_none(const Field& field, const toml::node& value) {
  if (field.none == "0") return value.is_number() && *value.value<double>() == 0;
  const auto* word = value.as_string();
  return word && !field.none.empty() && word->get() == field.none;
}

template <class T>
std::string assign_integer(const Field& field, const std::string& key, T& to, const toml::node& value) {
  if (const auto* i = value.as_integer()) {
    if (!inside(static_cast<double>(i->get()), field.range)) return out_of_range(field, key, value);
    to = static_cast<typename Number<T>::Type>(i->get());
    return {};
  }
  const auto* x = value.as_floating_point();
  if (!x) return wrong_type(field, key, value);
  if (!inside(x->get(), field.range)) return out_of_range(field, key, value);
  // Up to 2^53 a double holds every integer, so the text meant exactly this one.
  if (x->get() != std::floor(x->get()) || x->get() > 9007199254740992.0) return wrong_type(field, key, value);
  to = static_cast<typename Number<T>::Type>(x->get());
  return {};
}

template <class T>
std::string assign_real(const Field& field, const std::string& key, T& to, const toml::node& value) {
  if (!value.is_number()) return wrong_type(field, key, value);
  const double x = *value.value<double>();
  if (!inside(x, field.range)) return out_of_range(field, key, value);
  to = x;
  return {};
}

std::string unknown_word(const Field& field, const std::string& key, const std::string& given) {
  return fmt::format("{} = {} is not a known value: it must be {}{}", key, toml_string(given), accepted(field),
                     spelling_hint(given, field.choices));
}

std::string assign_choice(const Field& field, const std::string& key, const ChoiceSlot& to, const toml::node& value) {
  const auto* text = value.as_string();
  if (!text) return wrong_type(field, key, value);
  const auto word = std::ranges::find(to.words, std::string_view(text->get()));
  if (word == to.words.end()) return unknown_word(field, key, text->get());
  to.chosen->value = static_cast<uint8_t>(word - to.words.begin());
  return {};
}

std::string assign_text(const Field& field, const std::string& key, std::string& to, const toml::node& value,
                        const std::filesystem::path& folder) {
  const auto* text = value.as_string();
  if (!text) return wrong_type(field, key, value);
  const std::string& given = text->get();
  if (field.required && given.empty()) return key + " is empty: give it a name";
  if (field.form == Form::plain && has_control_character(given))  // names of files may contain such characters
    return fmt::format("{} = {} contains a control character, which tables and plots cannot show: remove it", key,
                       toml_string(given));
  to = given;
  if (field.form == Form::input_file) to = resolved_path(folder, given);
  if (field.form == Form::output_folder) to = resolved_path("", given);  // relative to the current folder, like -o
  if (field.choices.empty() || std::find(field.choices.begin(), field.choices.end(), given) != field.choices.end())
    return {};
  // A dot or a slash distinguishes a file from a misspelt name.
  if (field.form == Form::choice_or_file && given.find_first_of("./") != std::string::npos) {
    to = resolved_path(folder, given);
    return {};
  }
  return unknown_word(field, key, given);
}

template <size_t N>
std::string assign_vector(const Field& field, const std::string& key, std::array<double, N>& to,
                          const toml::node& value, std::string_view wanted) {
  const auto* array = value.as_array();
  if (!array) return fmt::format("{} must be {}, not {}", key, wanted, kind_of(value));
  if (array->size() != N) return fmt::format("{} must be {}, not {}", key, wanted, array->size());
  for (size_t i = 0; i < N; ++i) {
    const std::string element = fmt::format("{}[{}]", key, i);
    const toml::node& node = (*array)[i];
    if (!node.is_number()) return fmt::format("{} must be a number, not {}", element, kind_of(node));
    to[i] = *node.value<double>();
    if (!inside(to[i], field.range))
      return fmt::format("{} = {} is out of range: it must be {}", element, unquoted(node), number_of(field.range));
  }
  return {};
}

std::string assign_words(const Field& field, const std::string& key, std::vector<std::string>& to,
                         const toml::node& value) {
  to.clear();
  if (const auto* word = value.as_string()) {
    to.push_back(word->get());
  } else if (const auto* array = value.as_array()) {
    for (const toml::node& node : *array) {
      if (!node.is_string()) return fmt::format("{}[{}] must be a string, not {}", key, to.size(), kind_of(node));
      to.push_back(node.as_string()->get());
    }
  } else {
    return wrong_type(field, key, value);
  }
  return to.empty() ? key + " is empty: give at least one" : "";
}

std::string assign_numbers(const Field& field, const std::string& key, std::vector<double>& to,
                           const toml::node& value) {
  const auto* array = value.as_array();
  if (!array) return wrong_type(field, key, value);
  to.resize(array->size());
  for (size_t i = 0; i < to.size(); ++i) {
    const toml::node& node = (*array)[i];
    if (!node.is_number()) return fmt::format("{}[{}] must be a number, not {}", key, i, kind_of(node));
    to[i] = *node.value<double>();
    if (!inside(to[i], field.range))
      return fmt::format("{}[{}] = {} is out of range: the key takes {}", key, i, unquoted(node), accepted(field));
  }
  return {};
}

// Reads one layer of a wall; key: that of the layer.
std::string assign_layer(const Field& field, const std::string& key, LayerConfig& to, const toml::node& value) {
  const auto* table = value.as_table();
  if (!table) return fmt::format("{} must be a table with material and thickness_m, not {}", key, kind_of(value));
  for (const auto& [name, node] : *table)
    if (name != "material" && name != "thickness_m")
      return fmt::format("{} has an unknown key \"{}\": a layer has material and thickness_m", key, name.str());
  for (const char* name : {"material", "thickness_m"})
    if (!table->contains(name)) return fmt::format("{} has no {}: a layer has material and thickness_m", key, name);
  const toml::node &material = *table->get("material"), &thickness = *table->get("thickness_m");
  const std::string name_key = key + ".material", thickness_key = key + ".thickness_m";
  if (!material.is_string()) return fmt::format("{} must be a string, not {}", name_key, kind_of(material));
  to.material = material.as_string()->get();
  if (to.material.empty()) return name_key + " is empty: give the name of a material";
  if (!thickness.is_number()) return fmt::format("{} must be a number, not {}", thickness_key, kind_of(thickness));
  to.thickness_m = *thickness.value<double>();
  if (inside(to.thickness_m, field.range)) return {};
  return fmt::format("{} = {} is out of range: it must be {}", thickness_key, unquoted(thickness),
                     number_of(field.range));
}

std::string assign_layers(const Field& field, const std::string& key, std::vector<LayerConfig>& to,
                          const toml::node& value) {
  const auto* array = value.as_array();
  if (!array) return wrong_type(field, key, value);
  if (array->empty()) return key + " is empty: give at least one layer";
  if (array->size() > most_layers)
    return fmt::format("{} has {} layers: a wall may have {} at most", key, array->size(), most_layers);
  to.resize(array->size());
  for (size_t i = 0; i < to.size(); ++i)
    if (const std::string problem = assign_layer(field, fmt::format("{}[{}]", key, i), to[i], (*array)[i]);
        !problem.empty())
      return problem;
  return {};
}

// Reads rows of N numbers; the list may be empty if the field is not required.
template <size_t N>
std::string assign_rows(const Field& field, const std::string& key, std::vector<std::array<double, N>>& to,
                        const toml::node& value, const char* count, const char* row) {
  const auto* array = value.as_array();
  if (!array) return wrong_type(field, key, value);
  to.resize(array->size());
  for (size_t i = 0; i < to.size(); ++i) {
    const std::string problem = assign_vector(field, fmt::format("{}[{}]", key, i), to[i], (*array)[i],
                                              fmt::format("{} numbers ({})", count, field.unit));
    if (!problem.empty()) return problem;
  }
  return to.empty() && field.required ? fmt::format("{} is empty: give at least one {}", key, row) : "";
}

}  // namespace

std::string resolved_path(const std::filesystem::path& folder, const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(folder / path).lexically_normal().string();
}

std::string assign(const Field& field, const std::string& key, const Slot& slot, const toml::node& value,
                   const std::filesystem::path& folder) {
  return std::visit(
      Overload{
          [&](std::string* to) { return assign_text(field, key, *to, value, folder); },
          [&](bool* to) {
            if (!value.is_boolean()) return wrong_type(field, key, value);
            *to = value.as_boolean()->get();
            return std::string();
          },
          [&](std::array<double, 3>* to) { return assign_vector(field, key, *to, value, accepted(field)); },
          [&]<size_t N>(std::optional<std::array<double, N>>* to) {
            return assign_vector(field, key, to->emplace(), value, accepted(field));
          },
          [&](std::vector<std::string>* to) { return assign_words(field, key, *to, value); },
          [&](std::vector<LayerConfig>* to) { return assign_layers(field, key, *to, value); },
          [&](std::vector<double>* to) { return assign_numbers(field, key, *to, value); },
          [&](std::vector<std::array<double, 3>>* to) {
            return assign_rows(field, key, *to, value, "three", "position");
          },
          [&](std::vector<std::array<double, 4>>* to) {
            return assign_rows(field, key, *to, value, "four", "waypoint");
          },
          [&](std::vector<std::array<double, 7>>* to) { return assign_rows(field, key, *to, value, "seven", "lobe"); },
          [&](Aliases* to) {  // key is that of one entry: table.field.NAME
            if (!value.is_string()) return fmt::format("{} must be a string, not {}", key, kind_of(value));
            const size_t dot = key.find('.', key.find('.') + 1);
            (*to)[key.substr(dot + 1)] = value.as_string()->get();
            return std::string();
          },
          [&](const ChoiceSlot& to) { return assign_choice(field, key, to, value); },
          [&]<class T>(T* to) {
            if constexpr (Number<T>::optional)
              if (says_none(field, value)) {
                to->reset();
                return std::string();
              }
            if constexpr (is_integer<T>)
              return assign_integer(field, key, *to, value);
            else
              return assign_real(field, key, *to, value);
          },
      },
      slot);
}

}  // namespace wavetracer::config
