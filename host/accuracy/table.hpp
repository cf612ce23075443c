// The rows of a study as a table: accuracy.csv, lines for a terminal, HTML.
#pragma once
#include <string>
#include <vector>
#include "accuracy/study.hpp"

namespace wavetracer::accuracy {

// Names of the columns of accuracy.csv. A number is empty where a row has none.
const std::vector<std::string>& csv_columns();
std::string encode_csv(const std::vector<Row>& rows);

// What people read of a row; the first three cells are words.
std::vector<std::string> short_columns();
std::vector<std::string> short_cells(const Row& row);
// Aligned, a line per row.
std::string encode_text(const std::vector<Row>& rows);

}  // namespace wavetracer::accuracy
