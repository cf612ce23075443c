// SPDX-License-Identifier: Apache-2.0
// Writes the rows of a study as a table: accuracy.csv, lines for a terminal, HTML.
#pragma once
#include <string>
#include <vector>
#include "accuracy/study.hpp"

namespace wavetracer::accuracy {

// Returns the names of the columns of accuracy.csv. A number is empty if a row has none.
const std::vector<std::string>& csv_columns();
std::string encode_csv(const std::vector<Row>& rows);

// Returns the columns that people read; the first three cells are words.
std::vector<std::string> short_columns();
std::vector<std::string> short_cells(const Row& row);
// Returns aligned lines, one per row.
std::string encode_text(const std::vector<Row>& rows);

}  // namespace wavetracer::accuracy
