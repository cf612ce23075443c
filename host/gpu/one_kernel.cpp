// SPDX-License-Identifier: Apache-2.0
// Scans the text at the level of declarations: comments, directives and strings are skipped, braces are counted.
#include "gpu/one_kernel.hpp"
#include <cctype>
#include <vector>

namespace wavetracer::gpu {

namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

struct KernelPlace {
  std::string_view name;
  size_t begin, end;  // its place in the text, from the end of the declaration before it
};

class KernelScan {
 public:
  explicit KernelScan(std::string_view text) : text_(text) {}

  // Returns the kernels of the text; none if its braces do not match.
  std::vector<KernelPlace> kernels() {
    while (at_ < text_.size()) step();
    return depth_ == 0 ? found_ : std::vector<KernelPlace>{};
  }

 private:
  std::string_view text_;
  size_t at_ = 0, declaration_ = 0;
  int depth_ = 0;
  bool of_kernel_ = false;          // true if the current declaration is that of a kernel
  std::string_view word_, called_;  // the last word, and the one before the last parenthesis of a declaration
  std::vector<KernelPlace> found_;

  void skip_to(std::string_view end) {
    const size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }

  void skip_directive() {
    do skip_to("\n");
    while (at_ < text_.size() && at_ > 1 && text_[at_ - 2] == '\\');
    if (depth_ == 0) begin_declaration();
  }

  void skip_parentheses() {
    for (int open = 1; open > 0 && at_ < text_.size(); ++at_) open += (text_[at_] == '(') - (text_[at_] == ')');
  }

  void begin_declaration() {
    declaration_ = at_;
    of_kernel_ = false;
    called_ = {};
  }

  void take_word() {
    const size_t begin = at_;
    while (at_ < text_.size() && is_of_word(text_[at_])) ++at_;
    word_ = text_.substr(begin, at_ - begin);
    if (depth_ == 0 && (word_ == "kernel" || word_ == "__kernel")) of_kernel_ = true;
  }

  void close_brace() {
    if (--depth_ != 0) return;
    if (of_kernel_) found_.push_back({called_, declaration_, at_});
    begin_declaration();
  }

  void step() {
    const char c = text_[at_];
    if (is_of_word(c)) return take_word();
    if (text_.substr(at_).starts_with("//")) return skip_to("\n");
    if (text_.substr(at_).starts_with("/*")) return skip_to("*/");
    ++at_;
    if (c == '"') return skip_to("\"");
    if (c == '#') return skip_directive();
    if (c == '{') ++depth_;
    if (c == '}') return close_brace();
    if (depth_ != 0) return;
    if (c == ';') begin_declaration();
    if (c == '(' && word_ == "__attribute__") return skip_parentheses();
    if (c == '(' && of_kernel_ && called_.empty()) called_ = word_;
  }
};

}  // namespace

std::string with_one_kernel(std::string source, std::string_view kernel) {
  const std::string text = source;
  for (const KernelPlace& place : KernelScan(text).kernels())
    if (place.name != kernel)
      for (size_t i = place.begin; i < place.end; ++i)
        if (source[i] != '\n') source[i] = ' ';
  return source;
}

}  // namespace wavetracer::gpu
