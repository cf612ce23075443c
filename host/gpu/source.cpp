// SPDX-License-Identifier: Apache-2.0
// Expands a program's source: every line `#include "name"` is replaced by the file that it names, as in C. Files must
// have include guards. A file that was included under a condition before is inserted again; otherwise its guard would
// make it empty, so it is left out, as compilers read all text. `#include <...>` is left to the compiler.
#include "gpu/source.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>
#include "base/hash.hpp"
#include "gpu/gpu.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

namespace {

struct File {
  std::string path;  // the name for build logs
  std::string text;
};

std::vector<std::span<const EmbeddedFile>>& added_files() {
  static std::vector<std::span<const EmbeddedFile>> files;
  return files;
}

std::optional<File> find_among(std::span<const EmbeddedFile> files, std::initializer_list<const char*> folders,
                               const std::string& name) {
  for (const EmbeddedFile& file : files)
    for (const char* folder : folders)
      if (file.path == folder + name) return File{std::string(file.path), std::string(file.text)};
  return std::nullopt;
}

// Tells whether a path below a folder of kernels is that of a program, in whichever folder there.
bool is_program(std::string_view path, const std::string& program) {
  const std::string file = "/" + program + ".cl";
  return path.ends_with(file) || path == std::string_view(file).substr(1);
}

// The source of files: the embedded table, or a kernels folder on disk with include/ beside it.
class Source {
 public:
  Source() {
    if (const char* folder = std::getenv("WAVETRACER_KERNEL_DIR"); folder && *folder) folder_ = folder;
  }

  // name is relative to kernels/, or to include/ as in C++.
  std::optional<File> find(const std::string& name) const {
    if (!folder_.empty()) {
      for (const std::filesystem::path& found : {folder_ / name, folder_ / ".." / "include" / name}) {
        const std::filesystem::path path = found.lexically_normal();
        if (std::ifstream in(path, std::ios::binary); in && std::filesystem::is_regular_file(path)) {
          return File{path.generic_string(), std::string(std::istreambuf_iterator<char>(in), {})};
        }
      }
    } else if (auto file = find_among(embedded_files(), {"kernels/", "include/"}, name)) {
      return file;
    }
    for (const auto& files : added_files())
      if (auto file = find_among(files, {"tests/kernels/"}, name)) return file;
    return std::nullopt;
  }

  // program is a file's name without its folder and its end: "radix_sort" is primitives/radix_sort.cl.
  std::optional<File> find_program(const std::string& program) const {
    if (!folder_.empty()) {
      for (const std::filesystem::path& path : files_in(folder_))
        if (is_program(path.lexically_relative(folder_).generic_string(), program))
          return find(path.lexically_relative(folder_).generic_string());
    } else if (auto file = find_program_among(embedded_files(), program)) {
      return file;
    }
    for (const auto& files : added_files())
      if (auto file = find_program_among(files, program)) return file;
    return std::nullopt;
  }

  // The hash covers the names and texts of all files.
  std::string hash() const {
    ContentHash out;
    const auto add = [&out](std::string_view text) { out.add(std::as_bytes(std::span(text))); };
    if (folder_.empty())
      for (const EmbeddedFile& file : embedded_files())
        for (const std::string_view text : {file.path, file.text}) add(text);
    else
      for (const std::filesystem::path& path : files_on_disk()) {
        std::ifstream in(path, std::ios::binary);
        add(path.filename().string());
        add(std::string(std::istreambuf_iterator<char>(in), {}));
      }
    return fmt::format("{:016x}", out.value());
  }

  std::string place() const {
    return folder_.empty() ? std::string("the kernels built into wavetracer")
                           : fmt::format("{} (WAVETRACER_KERNEL_DIR) or ../include beside it", folder_.string());
  }

 private:
  static std::optional<File> find_program_among(std::span<const EmbeddedFile> files, const std::string& program) {
    for (const EmbeddedFile& file : files)
      if (is_program(file.path, program)) return File{std::string(file.path), std::string(file.text)};
    return std::nullopt;
  }

  static std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    std::error_code error;  // a missing folder has no files
    for (std::filesystem::recursive_directory_iterator at(folder, error), end; at != end; at.increment(error))
      if (at->is_regular_file(error)) out.push_back(at->path());
    std::ranges::sort(out);
    return out;
  }

  std::vector<std::filesystem::path> files_on_disk() const {
    std::vector<std::filesystem::path> out = files_in(folder_);
    for (std::filesystem::path& path : files_in(folder_ / ".." / "include" / "wavetracer" / "device"))
      out.push_back(std::move(path));
    std::ranges::sort(out);
    return out;
  }

  std::filesystem::path folder_;
};

void skip_blanks(std::string_view& line) { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); }

// Returns the text of a directive after its # and blanks, which are allowed where C allows them; empty for other lines.
std::string_view directive_of(std::string_view line) {
  skip_blanks(line);
  if (!line.starts_with('#')) return {};
  line.remove_prefix(1);
  skip_blanks(line);
  return line;
}

// Returns the file named by a directive `include "name"`.
std::optional<std::string> included_name(std::string_view directive) {
  if (!directive.starts_with("include")) return std::nullopt;
  directive.remove_prefix(7);
  skip_blanks(directive);
  if (!directive.starts_with('"')) return std::nullopt;
  directive.remove_prefix(1);
  const size_t end = directive.find('"');
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(directive.substr(0, end));
}

// Tells whether a whole file is under an include guard, as its first two directives say.
bool is_guarded(std::string_view text) {
  std::string name;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view directive = directive_of(text.substr(begin, end - begin));
    begin = end + 1;
    if (directive.empty()) continue;
    if (!name.empty()) return directive.starts_with("define" + name);
    if (!directive.starts_with("ifndef ")) return false;
    name = directive.substr(6);
  }
  return false;
}

class Expansion {
 public:
  explicit Expansion(const Source& source) : source_(source) {}

  void append(const File& file) {
    open_.push_back(file.path);
    const size_t conditions = conditions_;
    bool guard = is_guarded(file.text);
    out_ += fmt::format("#line 1 \"{}\"\n", file.path);
    const std::string_view text = file.text;
    size_t number = 1;
    for (size_t begin = 0; begin < text.size(); ++number) {
      const size_t end = std::min(text.find('\n', begin), text.size());
      const std::string_view line = text.substr(begin, end - begin), directive = directive_of(line);
      begin = end + 1;
      if (directive.starts_with("if")) {
        conditions_ += !guard;
        guard = false;
      } else if (directive.starts_with("endif") && conditions_ > conditions) {
        --conditions_;
      }
      append_line(file, number, line, directive);
    }
    conditions_ = conditions;
    open_.pop_back();
  }

  std::string take() { return std::move(out_); }

 private:
  void append_line(const File& file, size_t number, std::string_view line, std::string_view directive) {
    const std::optional<std::string> name = included_name(directive);
    if (!name) {
      out_.append(line).push_back('\n');
      return;
    }
    const std::optional<File> included = source_.find(*name);
    if (!included) {
      throw DeviceError(
          fmt::format("{}:{}: included file \"{}\" is not in {}; names are relative to kernels/ or include/", file.path,
                      number, *name, source_.place()));
    }
    // A file inside itself would be empty because of its guard; leaving it out ends a circle.
    if (std::find(open_.begin(), open_.end(), included->path) == open_.end() && !there_.contains(included->path)) {
      if (conditions_ == 0) there_.insert(included->path);
      append(*included);
    }
    out_ += fmt::format("#line {} \"{}\"\n", number + 1, file.path);
  }

  const Source& source_;
  std::vector<std::string> open_;  // the files being expanded, outermost first
  std::set<std::string> there_;    // the files that were included under no condition
  size_t conditions_ = 0;          // number of conditions around the line, without guards
  std::string out_;
};

// Reads a line `#line NUMBER "FILE"`; any other line gives nothing.
std::optional<std::pair<size_t, std::string>> directive(std::string_view line) {
  constexpr std::string_view start = "#line ", before_name = " \"";
  if (!line.starts_with(start)) return std::nullopt;
  line.remove_prefix(start.size());
  size_t number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  line.remove_prefix(static_cast<size_t>(end - line.data()));
  if (error != std::errc() || !line.starts_with(before_name) || line.size() <= before_name.size() ||
      !line.ends_with('"'))
    return std::nullopt;
  line.remove_prefix(before_name.size());
  line.remove_suffix(1);
  return std::pair(number, std::string(line));
}

}  // namespace

void add_files(std::span<const EmbeddedFile> files) { added_files().push_back(files); }

std::string program_source(const std::string& program) {
  const Source source;
  const std::optional<File> file = source.find_program(program);
  if (!file)
    throw DeviceError(
        fmt::format("kernel program \"{}\": {}.cl is in no folder of {}", program, program, source.place()));
  Expansion expansion(source);
  if (const std::optional<File> prelude = source.find("lib/prelude.clh")) expansion.append(*prelude);
  expansion.append(*file);
  return expansion.take();
}

std::string hash_of_sources() { return Source().hash(); }

std::string with_places(const std::string& log, const std::string& source) {
  std::vector<std::string> places;  // for each line of the source
  std::istringstream lines(source);
  std::string file;
  size_t number = 0;
  for (std::string line; std::getline(lines, line); ++number) {
    places.push_back(fmt::format("{}:{}:", file, number));
    if (const auto named = directive(line)) {
      number = named->first - 1;
      file = named->second;
    }
  }
  std::string out;
  for (std::string_view rest = log;;) {
    constexpr std::string_view names[] = {"<kernel>:", "input.cl:"};  // drivers have these for the source
    static_assert(names[0].size() == names[1].size());
    const size_t at = std::min(rest.find(names[0]), rest.find(names[1]));
    if (at == std::string_view::npos) return out.append(rest);
    const std::string_view after = rest.substr(at + names[0].size());
    size_t line = 0;
    const auto [end, error] = std::from_chars(after.data(), after.data() + after.size(), line);
    const auto digits = static_cast<size_t>(end - after.data());
    if (error == std::errc() && after.substr(digits).starts_with(':') && line > 0 && line <= places.size()) {
      out.append(rest.substr(0, at)).append(places[line - 1]);
      rest = after.substr(digits + 1);
    } else {
      out.append(rest.substr(0, at + names[0].size()));
      rest = after;
    }
  }
}

}  // namespace wavetracer::gpu
