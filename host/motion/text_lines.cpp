// SPDX-License-Identifier: Apache-2.0
// Splits chunks into lines.
#include "motion/text_lines.hpp"

#include "motion/input_text.hpp"

namespace wavetracer {

void TextLines::fail(std::string_view what) const { fail_at(file(), number_, what); }

bool TextLines::next() {
  constexpr size_t longest = 1 << 20;
  line_.clear();
  bool found = false;
  while (!found) {
    if (rest_.empty()) rest_ = stream_.next();
    if (rest_.empty()) break;
    const size_t end = rest_.find('\n');
    found = end != rest_.npos;
    line_ += rest_.substr(0, end);
    rest_.remove_prefix(found ? end + 1 : rest_.size());
    if (line_.size() > longest) fail_at(file(), number_ + 1, "the line does not end; this is no file of trajectories");
  }
  if (!found && line_.empty()) return false;
  if (++number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);  // byte order mark of UTF-8
  if (line_.ends_with('\r')) line_.pop_back();
  return true;
}

}  // namespace wavetracer
