// SPDX-License-Identifier: Apache-2.0
// A table as a list of columns: each has a name and a function for a row's cell.
// Cells are separated by commas; none needs quotes. Numbers have six digits: more than a clock is good for.
#pragma once
#include <fmt/format.h>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace wavetracer::study {

template <class Row>
struct Column {
  // get: a member, or a function of a row; returns text, a whole number, a truth value or a number.
  template <class Get>
  Column(std::string column, Get get)
      : name(std::move(column)), cell([get](const Row& row) {
          const auto& value = std::invoke(get, row);
          if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
            return fmt::format("{:.6g}", value);
          else
            return fmt::format("{}", value);
        }) {}

  std::string name;
  std::function<std::string(const Row&)> cell;
};

template <class Row>
using Columns = std::vector<Column<Row>>;

template <class Row>
std::vector<std::string> names_of(const Columns<Row>& columns) {
  std::vector<std::string> out;
  for (const Column<Row>& column : columns) out.push_back(column.name);
  return out;
}

// Returns the names, then a line for each row.
template <class Row>
std::string encode(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(names_of(columns), ","));
  for (const Row& row : rows) {
    for (const Column<Row>& column : columns) text += (&column == &columns.front() ? "" : ",") + column.cell(row);
    text += "\n";
  }
  return text;
}

}  // namespace wavetracer::study
