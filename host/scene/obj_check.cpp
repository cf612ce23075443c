// SPDX-License-Identifier: Apache-2.0
// Statements as in "Advanced Visualizer", appendix B1 (Wavefront Technologies, 1990s).
#include "scene/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <string_view>

#include "base/input_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

enum class Statement { read, harmless, flat, curved, called, unknown };

Statement statement_of(std::string_view word) {
  static const std::set<std::string_view> read = {"v", "f", "fo", "o", "g", "usemtl", "mtllib"};
  // These say how things look, or are parameters of curves; curves themselves are left out.
  static const std::set<std::string_view> harmless = {
      "vt",         "vn",        "vp",    "s",     "mg",  "bevel", "c_interp", "d_interp", "lod",
      "usemap",     "maplib",    "parm",  "trim",  "sp",  "hole",  "scrv",     "end",      "con",
      "shadow_obj", "trace_obj", "ctech", "stech", "deg", "bmat",  "step",     "cstype",   "res"};
  static const std::set<std::string_view> curved = {"curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp"};
  if (read.contains(word)) return Statement::read;
  if (harmless.contains(word)) return Statement::harmless;
  if (word == "l" || word == "p") return Statement::flat;
  if (curved.contains(word)) return Statement::curved;
  return word == "call" || word == "csh" ? Statement::called : Statement::unknown;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

class ObjCheck {
 public:
  explicit ObjCheck(const std::filesystem::path& path) : path_(path) {}

  std::vector<std::string> run() {
    std::ifstream in(path_, std::ios::binary);
    std::string line, part;
    for (size_t number = 1; std::getline(in, part); ++number) {
      if (number == 1 && part.starts_with("\xEF\xBB\xBF")) part.erase(0, 3);
      while (!part.empty() && is_blank(part.back())) part.pop_back();
      if (part.find('\r') != std::string::npos) return {};  // line ends of old Macs, which assimp accepts as well
      const bool goes_on = part.ends_with('\\');
      if (goes_on) part.back() = ' ';
      line += part;
      if (goes_on) continue;
      check(line, number);
      line.clear();
    }
    return warnings();
  }

 private:
  struct Seen {
    uint64_t count = 0;
    size_t first_line = 0;
    void add(size_t line) {
      if (count++ == 0) first_line = line;
    }
  };

  [[noreturn]] void fail(size_t number, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_.string(), number, what));
  }

  void check(std::string_view line, size_t number) {
    const size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') return;
    // assimp would read beyond the end of the file.
    if (line.find_first_of("\v\f") != std::string_view::npos)
      fail(number, "a vertical tab or a form feed stands in this line: leave it out");
    const std::string_view text = line.substr(first);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    const Statement statement = statement_of(word);
    if (statement == Statement::read && first > 0)
      fail(number, fmt::format("blanks stand before '{}': a statement must begin its line", word));
    if (statement == Statement::called)
      fail(number, fmt::format("'{}' reads another file, which is not done: put its content into this one", word));
    if (statement == Statement::flat) flat_.add(number);
    if (statement == Statement::curved) curved_.add(number);
    if (statement == Statement::unknown) unknown_[std::string(word.substr(0, 40))].add(number);
    if (word == "v") check_vertex(text.substr(1), number);
    if (word == "f" || word == "fo") check_face(text.substr(word.size()), number);
    if (word == "mtllib") check_library(text.substr(word.size()), number);
  }

  void check_vertex(std::string_view numbers, size_t number) const {
    // Digits, and the letters of "inf" and "nan", which are refused later.
    constexpr std::string_view possible = " \t\r0123456789+-.,eEnNaAiIfFtTyY";
    if (numbers.substr(0, numbers.find('#')).find_first_not_of(possible) != std::string_view::npos)
      fail(number, fmt::format("'v{}' is not a vertex of numbers", numbers.substr(0, 80)));
  }

  void check_face(std::string_view corners, size_t number) {
    size_t count = 0;
    for (size_t at = corners.find_first_not_of(" \t"); at != std::string_view::npos && corners[at] != '#';
         at = corners.find_first_not_of(" \t", at)) {
      ++count;
      at = std::min(corners.find_first_of(" \t", at), corners.size());
    }
    if (count < 3) small_.add(number);
  }

  // Only the names of materials are used, so a missing library is reported only if its name looks wrong.
  void check_library(std::string_view name, size_t number) {
    name.remove_prefix(std::min(name.find_first_not_of(" \t"), name.size()));
    const auto is_slash = [](char c) { return c == '/' || c == '\\'; };
    if (std::ranges::adjacent_find(name, [&](char a, char b) { return is_slash(a) && is_slash(b); }) != name.end())
      fail(number, "the name of the library has two slashes in a row: leave out one of them");  // assimp fails on it
    const std::filesystem::path file = path_.parent_path() / name;
    std::error_code unnameable;
    if (name.empty() || std::filesystem::exists(file, unnameable)) return;
    if (const std::string hint = backslash_hint(file); !hint.empty())
      library_.push_back(fmt::format("{}:{}: there is no file {}{}", path_.string(), number, file.string(), hint));
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> out = library_;
    const auto warn = [&](const Seen& seen, const std::string& what) {
      if (seen.count > 0) out.push_back(fmt::format("{}:{}: {} {}", path_.string(), seen.first_line, seen.count, what));
    };
    warn(flat_, "lines and points were left out: they are no surfaces");
    warn(small_, "faces of fewer than three vertices were left out");
    warn(curved_, "curves and curved surfaces were left out: export them as polygons");
    for (const auto& [word, seen] : unknown_)
      warn(seen, fmt::format("statements '{}' are not known and were left out", word));
    return out;
  }

  const std::filesystem::path& path_;
  Seen flat_, small_, curved_;
  std::map<std::string, Seen> unknown_;
  std::vector<std::string> library_;
};

}  // namespace

std::vector<std::string> check_obj(const std::filesystem::path& path) { return ObjCheck(path).run(); }

}  // namespace wavetracer
