// SPDX-License-Identifier: Apache-2.0
// Reads records of a CSV file by RFC 4180, from blocks that contain whole records.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// The file in blocks of some megabytes, each cut after its last line end outside of quotes.
class CsvBlocks {
 public:
  explicit CsvBlocks(const std::filesystem::path& file) : file_(file, std::ios::binary) {}
  // Returns false if nothing is left.
  bool next(std::string& block);

 private:
  std::ifstream file_;
  std::string rest_;  // the text after the cut
};

// Removes the first record from the text and returns its fields, without their quotes. A quoted field may contain line
// ends. Returns false if no text is left.
bool take_record(std::string_view& text, std::vector<std::string>& fields);

}  // namespace wavetracer
