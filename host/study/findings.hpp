// What a recipe says of its measurement: sentences, a verdict on each claim, and the numbers behind them as a table.
// The report, the terminal and the thesis' page show the same.
#pragma once
#include <string>
#include <vector>

namespace wavetracer::study {

struct Verdict {
  std::string claim, measured;
};

struct NumberTable {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  // as many cells as heads
};

struct Words {
  std::string paragraph;
  std::vector<Verdict> verdicts = {};
  NumberTable numbers = {};
};

NumberTable verdict_table(const std::vector<Verdict>& verdicts);

// In Markdown, columns aligned, so that it can be read as it is.
std::string markdown(const NumberTable& table);
// The paragraph, the verdicts and the numbers; without an end of line.
std::string words_text(const Words& words);

// "12.3", "1230", "0.0012", "less than 0.001": never an exponent. digits: those that count.
std::string plain(double value, int digits = 3);

}  // namespace wavetracer::study
