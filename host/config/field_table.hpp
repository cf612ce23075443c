// SPDX-License-Identifier: Apache-2.0
// The field table: every key of the config file, once. Parsing, `validate`, `init`, `--help` and hints all read it.
// Defaults are in config.hpp; a field only says where its member is, so the two cannot disagree.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::config {

using Aliases = std::map<std::string, std::string>;
// A Choice of these words.
struct ChoiceSlot {
  ChoiceIndex* chosen;
  std::span<const std::string_view> words;
};
// A pointer to the value of a field. The alternative that it holds is the type of the field.
using Slot =
    std::variant<std::string*, bool*, uint32_t*, uint64_t*, double*, std::optional<uint32_t>*, std::optional<uint64_t>*,
                 std::optional<double>*, std::array<double, 3>*, std::optional<std::array<double, 2>>*,
                 std::optional<std::array<double, 3>>*, Aliases*, std::vector<double>*, std::vector<std::string>*,
                 std::vector<std::array<double, 3>>*, std::vector<std::array<double, 4>>*,
                 std::vector<std::array<double, 7>>*, std::vector<LayerConfig>*, ChoiceSlot>;

// Numbers allowed, both ends included unless lower_open.
struct Range {
  double lower = -std::numeric_limits<double>::max();  // infinity is out of range by default
  double upper = std::numeric_limits<double>::max();
  bool lower_open = false;
};

// Ranges of values that have no tighter bound. Coordinates of files are 10^7 m at most; antennas are within 10^6 m of
// the middle of their scene, which world.cpp checks. Doppler shifts are of first order in v / c, and no antenna is as
// fast as light: each component is at most 10^8 m/s. Times since 1970 are about 2 10^9 s.
constexpr Range places{-1e9, 1e9}, speeds{-1e8, 1e8}, angles{-1e6, 1e6}, instants{-1e12, 1e12};

enum class Form {
  plain,           // a value, or one of `choices`
  choice_or_file,  // one of `choices`, or the path of a file
  input_file,      // the path of a file that must exist when the run starts
  output_folder,   // the path of a folder that the run creates
};

struct Field {
  std::string name;                           // without the name of its table
  std::function<Slot(Config&, size_t)> slot;  // the index is that of the element of an array of tables
  std::string unit = {};
  Range range = {};
  std::string none = {};                  // for an optional: "0" or the word that means "not set" in the file
  std::vector<std::string> choices = {};  // for a string; those of a Choice, and `none`, are added automatically
  Form form = Form::plain;
  bool required = false;
  std::string instead = {};  // for a required field: the key that may be given in its place
  std::string doc = {};
  // TOML that `init` writes instead of the default, as a comment unless the field is required or needed.
  std::string example = {};
  bool needed = false;  // not required, but the config of `init` would not run without its example
};

struct Table {
  std::string name;
  std::string doc;
  std::vector<Field> fields;
  // Set for an array of tables: append adds an element and returns its index; size returns the number of elements.
  size_t (*append)(Config&) = nullptr;
  size_t (*count)(const Config&) = nullptr;
  bool optional = false;  // an array of tables that `init` writes as a comment
};

const std::vector<Table>& tables();

// Returns a Config of defaults with one element in each array of tables, so that every slot exists at index 0.
Config prototype();

// Returns the value of the field as TOML; empty for an optional number that is not set, unless the field has a word for
// that.
std::string literal(const Field& field, const Slot& slot);
// Tells whether the key that may replace a required field is set.
bool replaced(const Table& table, const Field& field, Config& config, size_t element);
// Returns "required", and the key that may replace it.
std::string required_text(const Field& field);
// Describes a number of this range: `a number from 1 to 3`, `a finite number`.
std::string number_of(const Range& range);
// Describes what a field accepts: `integer from 1 to 3`, `"a" or "b"`, `three numbers (m)`.
std::string accepted(const Field& field);

// Type traits for code that visits a slot of the field table.
template <class T>
struct Number {
  using Type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Number<std::optional<T>> {
  using Type = T;
  static constexpr bool optional = true;
};
template <class T>
constexpr bool is_integer = std::is_integral_v<typename Number<T>::Type>;

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

}  // namespace wavetracer::config
