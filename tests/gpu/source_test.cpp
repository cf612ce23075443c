// Tests of the embedded sources and of include expansion: every line must still know its file and number.
// No device is needed.
#include "gpu/source.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <vector>
#include "folders.hpp"
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What a compiler makes of the expansion: (file, line) -> text.
std::map<std::pair<std::string, size_t>, std::string> located_lines(const std::string& source) {
  static const std::regex line_directive("#line ([0-9]+) \"(.*)\"");
  std::map<std::pair<std::string, size_t>, std::string> located;
  std::string file;
  size_t number = 0;
  for (const std::string& line : lines_of(source)) {
    if (std::smatch match; std::regex_match(line, match, line_directive)) {
      number = std::stoul(match[1]);
      file = match[2];
    } else {
      located[{file, number++}] = line;
    }
  }
  return located;
}

}  // namespace

TEST_CASE("embedded files are the files of the source tree, byte for byte") {
  bool trailing = false;
  std::string previous;
  for (const gpu::EmbeddedFile& file : gpu::embedded_files()) {
    CAPTURE(file.path);
    CHECK(std::string(file.text) == read_file(std::filesystem::path(test::source_folder()) / file.path));
    CHECK(previous < file.path);
    previous = file.path;
    trailing |= file.path == "kernels/lib/memory_order.clh";
  }
  CHECK(trailing);
}

TEST_CASE("an embedded program keeps the place of each of its lines") {
  const Environment built_in("WAVETRACER_KERNEL_DIR", nullptr);
  size_t checked = 0;
  for (const auto& [place, line] : located_lines(gpu::program_source("probe_memory_order"))) {
    const auto& [file, number] = place;
    const auto original = lines_of(read_file(std::filesystem::path(test::source_folder()) / file));
    CAPTURE(file);
    CAPTURE(number);
    REQUIRE(number >= 1);
    REQUIRE(number <= original.size());
    CHECK(line == original[number - 1]);
    checked += file == "kernels/lib/memory_order.clh";
  }
  CHECK(checked == lines_of(read_file(test::source_folder() + "/kernels/lib/memory_order.clh")).size());
}

TEST_CASE("kernels of tests are found wherever kernels come from, and are not built into the program") {
  const auto is_probe = [](const gpu::EmbeddedFile& file) { return contains(std::string(file.path), "probe"); };
  CHECK(std::ranges::none_of(gpu::embedded_files(), is_probe));
  CHECK(contains(gpu::program_source("probe_memory_order"), "#line 1 \"tests/kernels/probe_memory_order.cl\""));
  const TemporaryKernels kernels;
  kernels.add("lib/memory_order.clh", "from disk\n");
  CHECK(contains(gpu::program_source("probe_memory_order"), "from disk"));
}

TEST_CASE("includes: nested, odd blanks, angle brackets left alone, circles end, no last newline") {
  const TemporaryKernels kernels;
  kernels.add("main.cl", "#include \"lib/a.clh\"\n  #  include\t\"lib/b.clh\"  // again\n#include <other.h>\nlast");
  kernels.add("lib/a.clh", "a1\n#include \"lib/b.clh\"\na3\n");
  kernels.add("lib/b.clh", "b1\n#include \"lib/a.clh\"\n");
  const std::string main = (kernels.kernels() / "main.cl").string(), a = (kernels.kernels() / "lib/a.clh").string(),
                    b = (kernels.kernels() / "lib/b.clh").string();
  const std::map<std::pair<std::string, size_t>, std::string> expected{
      {{a, 1}, "a1"}, {{b, 1}, "b1"}, {{a, 3}, "a3"}, {{main, 3}, "#include <other.h>"}, {{main, 4}, "last"}};
  CHECK(located_lines(gpu::program_source("main")) == expected);
}

TEST_CASE("a file included in two branches of a condition is there in both") {
  const TemporaryKernels kernels;
  kernels.add("main.cl", "#if A\n#include \"lib/a.clh\"\n#else\n#include \"lib/a.clh\"\n#endif\n");
  kernels.add("lib/a.clh", "text\n");
  const std::string source = gpu::program_source("main");
  CHECK(source.find("text") < source.find("#else"));
  CHECK(source.rfind("text") > source.find("#else"));
}

TEST_CASE("device headers are found beside the kernels folder on disk") {
  const TemporaryKernels kernels;
  kernels.add("main.cl", "#include \"wavetracer/device/bvh.h\"\n");
  CHECK(contains(gpu::program_source("main"), "WT_LEAF_BITS"));
}

TEST_CASE("what is missing is named") {
  {
    const Environment built_in("WAVETRACER_KERNEL_DIR", nullptr);
    CHECK(contains(message_of<DeviceError>([] { gpu::program_source("no_such_program"); }), "no_such_program.cl"));
  }
  const TemporaryKernels kernels;
  kernels.add("main.cl", "int x;\n#include \"lib/absent.clh\"\n");
  const std::string missing_include = message_of<DeviceError>([] { gpu::program_source("main"); });
  CHECK(contains(missing_include, "main.cl:2"));
  CHECK(contains(missing_include, "lib/absent.clh"));
  CHECK(contains(missing_include, "WAVETRACER_KERNEL_DIR"));
  CHECK(contains(message_of<DeviceError>([] { gpu::program_source("other"); }), "other.cl"));
}

TEST_CASE("places in the logs of compilers that ignore #line are put right") {
  const std::string source = "#line 1 \"a.cl\"\none\n#line 1 \"lib/b.clh\"\nfirst\nsecond\n#line 3 \"a.cl\"\nthree\n";
  CHECK(gpu::with_places("<kernel>:5:7: error\n  input.cl:7:1: note: <kernel>:2:3:", source) ==
        "lib/b.clh:2:7: error\n  a.cl:3:1: note: a.cl:1:3:");
  CHECK(gpu::with_places("lib/b.clh:2:7: error; <kernel>:99:1: <kernel>:0:1:", source) ==
        "lib/b.clh:2:7: error; <kernel>:99:1: <kernel>:0:1:");
}
