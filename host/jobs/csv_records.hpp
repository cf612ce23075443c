// Records of a CSV file by RFC 4180, from blocks of it that hold whole records each.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// The file in blocks of some megabytes, each cut behind the last line end of it that is in no quotes.
class CsvBlocks {
 public:
  explicit CsvBlocks(const std::filesystem::path& file) : file_(file, std::ios::binary) {}
  // False where nothing is left.
  bool next(std::string& block);

 private:
  std::ifstream file_;
  std::string rest_;  // what comes behind the cut
};

// Takes the first record off the text: its fields, without their quotes. A quoted field may hold line ends. False where
// no text is left.
bool take_record(std::string_view& text, std::vector<std::string>& fields);

}  // namespace wavetracer
