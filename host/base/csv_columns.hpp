// SPDX-License-Identifier: Apache-2.0
// A table as a list of columns: each has a name and a function for a row's cell.
// Numbers have six digits: more than a clock is good for.
#pragma once
#include <fmt/format.h>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>
#include "base/csv.hpp"

namespace wavetracer {

// Returns the number as a cell, and "nan" if it is none.
inline std::string six_digits(double value) { return fmt::format("{:.6g}", value); }

template <class Row>
struct Column {
  // get: a member, or a function of a row; returns text, a whole number, a truth value ("true" or "false") or a number.
  template <class Get>
  Column(std::string column, Get get)
      : name(std::move(column)), cell([get](const Row& row) {
          const auto& value = std::invoke(get, row);
          if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
            return six_digits(value);
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

// Returns the table of the rows.
template <class Row>
Csv csv_of(const Columns<Row>& columns, const std::vector<Row>& rows) {
  Csv table(names_of(columns));
  std::vector<std::string> cells(columns.size());
  for (const Row& row : rows) {
    for (size_t i = 0; i < columns.size(); ++i) cells[i] = columns[i].cell(row);
    table.add_texts(cells);
  }
  return table;
}

}  // namespace wavetracer
