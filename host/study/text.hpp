// What an experiment says of its measurement: sentences, a verdict on each claim, and the numbers behind them.
// The report, the terminal and the thesis' page show the same. Numbers are rounded here; whoever compares them with the
// table of an experiment rounds likewise.
#pragma once
#include <map>
#include <string>
#include <vector>
#include "study/judgement.hpp"

namespace wavetracer::study {

struct Verdict {
  std::string claim;
  ClaimOutcome outcome;
  std::string measured;
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

// What takes the place of {NAME} in a text.
using Fields = std::map<std::string, std::string>;
// Throws std::runtime_error for a name that has no field.
std::string filled(const std::string& text, const Fields& fields);

// "12.3", "1230", "0.0012", "less than 0.001": never an exponent. digits: those that count.
std::string plain(double value, int digits = 3);
// A share as "2.5%", "0.031%" or "none".
std::string share_words(double share);
// "12% less time", "3.0% more time", "the same time" within half a percent.
std::string saved_words(double percent);
// "confirmed" or "not confirmed".
std::string verdict(bool holds);
// "a, b and c"
std::string list_words(const std::vector<std::string>& words);

}  // namespace wavetracer::study
