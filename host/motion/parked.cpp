// SPDX-License-Identifier: Apache-2.0
// The header names the columns; each row is a place.
#include "motion/parked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "motion/input_text.hpp"
#include "motion/text_rows.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer {
namespace {

enum ParkedColumn : size_t { parked_x, parked_y, parked_z, parked_yaw, parked_type };
constexpr std::array<std::string_view, 5> parked_names = {"x", "y", "z", "yaw", "type"};
constexpr size_t parked_needed = 2;  // number of names that are needed
constexpr std::string_view parked_advice =
    "the first line must be a header with the columns x,y and optionally z,yaw,type";

class ParkedReader {
 public:
  explicit ParkedReader(ByteStream& stream) : rows_(stream) {}

  std::vector<ParkedPlace> read() {
    if (!rows_.next()) throw InputError(fmt::format("{}: the file is empty; {}", rows_.file(), parked_advice));
    read_header();
    std::vector<ParkedPlace> out;
    while (rows_.next()) out.push_back(place());
    if (out.empty()) throw InputError(fmt::format("{}: there is no row below the header", rows_.file()));
    return out;
  }

 private:
  void read_header() {
    width_ = rows_.cells().size();
    for (size_t i = 0; i < width_; ++i) {
      const auto name = std::ranges::find(parked_names, lower_case(rows_.cells()[i]));
      if (name == parked_names.end())
        rows_.fail(fmt::format("there is no column '{}'; {}", rows_.cells()[i], parked_advice));
      std::optional<size_t>& column = column_[static_cast<size_t>(name - parked_names.begin())];
      if (column) rows_.fail(fmt::format("the header has the column '{}' twice", *name));
      column = i;
    }
    for (size_t i = 0; i < parked_needed; ++i)
      if (!column_[i]) rows_.fail(fmt::format("the header has no column '{}'; {}", parked_names[i], parked_advice));
  }

  std::string_view cell(ParkedColumn column) const {
    return column_[column] ? std::string_view(rows_.cells()[*column_[column]]) : std::string_view();
  }
  double number(ParkedColumn column) const {
    const std::string_view text = cell(column);
    if (text.empty() && column >= parked_needed) return 0;
    const std::optional<double> value = finite_number(text);
    if (!value) rows_.fail(fmt::format("{} = '{}' is not a finite number", parked_names[column], text));
    return *value;
  }

  ParkedPlace place() const {
    if (rows_.cells().size() != width_)
      rows_.fail(fmt::format("the row has {} cells, the header {}", rows_.cells().size(), width_));
    if (has_control_character(cell(parked_type))) rows_.fail("the type contains a control character: remove it");
    return {{number(parked_x), number(parked_y), number(parked_z)}, number(parked_yaw), std::string(cell(parked_type))};
  }

  CsvRows rows_;
  std::array<std::optional<size_t>, parked_names.size()> column_;
  size_t width_ = 0;
};

}  // namespace

std::vector<ParkedPlace> read_parked(const std::filesystem::path& path) {
  ByteStream stream(path, "file of parked vehicles");
  return ParkedReader(stream).read();
}

}  // namespace wavetracer
