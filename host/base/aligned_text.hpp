// SPDX-License-Identifier: Apache-2.0
// Cells as lines of text whose columns are aligned.
#pragma once
#include <string>
#include <vector>

namespace wavetracer {

// Returns a line for each row. Columns are as wide as their widest cell in bytes, and two blanks apart; no line ends
// with a blank. Rows may have different numbers of cells.
std::string aligned_text(const std::vector<std::vector<std::string>>& rows);

}  // namespace wavetracer
