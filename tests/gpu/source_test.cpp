// SPDX-License-Identifier: Apache-2.0
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
#include "gpu/one_kernel.hpp"
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

// Returns the lines of the expansion as a compiler locates them: (file, line) -> text.
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
    checked += file == "kernels/lib/memory_order_u32.clh";
  }
  CHECK(checked == lines_of(read_file(test::source_folder() + "/kernels/lib/memory_order_u32.clh")).size());
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

TEST_CASE("a guarded file is there once, where nothing in between depends on a condition") {
  const TemporaryKernels kernels;
  kernels.add("main.cl",
              "#include \"lib/b.clh\"\n#if A\n#include \"lib/c.clh\"\n#endif\n#include \"lib/a.clh\"\n"
              "#include \"lib/c.clh\"\n#include \"lib/c.clh\"\n");
  kernels.add("lib/a.clh", "// words\n#ifndef A_CLH\n#define A_CLH\ntext of a\n#if B\n#endif\n#endif\n");
  kernels.add("lib/b.clh", "#ifndef B_CLH\n#define B_CLH\n#include \"lib/a.clh\"\ntext of b\n#endif\n");
  kernels.add("lib/c.clh", "#ifndef C_CLH\n#define C_CLH\ntext of c\n#endif\n");
  const std::string source = gpu::program_source("main");
  const auto count = [&](const std::string& words) {
    int out = 0;
    for (size_t at = 0; (at = source.find(words, at)) != std::string::npos; ++at) ++out;
    return out;
  };
  CHECK(count("text of a") == 1);
  CHECK(count("text of b") == 1);
  CHECK(count("text of c") == 2);  // the first one may not be visible
}

TEST_CASE("a source with one of its kernels keeps its lines, and what is no kernel") {
  const std::string source =
      "#define HELP(x) { x\ninline int f(int a) { return a; }  // kernel void no(\n/* kernel void { */\n"
      "__attribute__((reqd_work_group_size(4, 1, 1))) kernel void first(\n    global int* a) {\n#if A\n  if (a) "
      "{\n#endif\n"
      "#if A\n  }\n#endif\n  a[0] = '1' + f(1);\n}\n\nkernel void second(global int* a) { a[1] = 2; }\n"
      "kernel __attribute__((vec_type_hint(float4))) void third(global int* a) {\n  printf(\"}\");\n}\n";
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  const std::string first = gpu::with_one_kernel(source, "first"), third = gpu::with_one_kernel(source, "third");
  for (const std::string* one : {&first, &third}) {
    CHECK(lines(*one) == lines(source));
    CHECK(contains(*one, "#define HELP(x) { x\ninline int f(int a) { return a; }"));
    CHECK_FALSE(contains(*one, "second"));
  }
  CHECK(contains(first, "reqd_work_group_size(4, 1, 1))) kernel void first("));
  CHECK(contains(first, "a[0] = '1' + f(1);\n}"));
  CHECK_FALSE(contains(first, "third"));
  CHECK_FALSE(contains(third, "first"));
  CHECK_FALSE(contains(third, "reqd_work_group_size"));
  CHECK(third.ends_with("void third(global int* a) {\n  printf(\"}\");\n}\n"));
  // If each branch of a condition opens a brace, kernels cannot be told apart.
  const std::string unmatched =
      "#if A\nkernel void a(int x) {\n#else\nkernel void a(int y) {\n#endif\n}\nkernel void b() {}\n";
  CHECK(gpu::with_one_kernel(unmatched, "b") == unmatched);
}

TEST_CASE("every kernel of ours is found by that") {
  for (const gpu::EmbeddedFile& file : gpu::embedded_files()) {
    if (!file.path.starts_with("kernels/") || !file.path.ends_with(".cl")) continue;
    CAPTURE(file.path);
    const std::string name = std::filesystem::path(file.path).stem().string(), whole = gpu::program_source(name);
    const std::string none = gpu::with_one_kernel(whole, "");
    CHECK(contains(whole, "kernel void "));
    CHECK_FALSE(contains(none, "kernel void "));
  }
}

TEST_CASE("a program is known by the name of its file, in whichever folder that is") {
  {
    const Environment built_in("WAVETRACER_KERNEL_DIR", nullptr);
    CHECK(contains(gpu::program_source("radix_sort"), "#line 1 \"kernels/primitives/radix_sort.cl\""));
    CHECK(contains(gpu::program_source("radix_sort_cpu"), "#line 1 \"kernels/primitives/radix_sort_cpu.cl\""));
    CHECK_FALSE(message_of<DeviceError>([] { gpu::program_source("sort"); }).empty());
  }
  const TemporaryKernels kernels;
  kernels.add("primitives/radix_sort.cl", "of the folder\n#include \"lib/a.clh\"\n");
  kernels.add("lib/a.clh", "of lib\n");
  kernels.add("flat.cl", "beside the folders\n");
  CHECK(contains(gpu::program_source("radix_sort"), "of the folder\n"));
  CHECK(contains(gpu::program_source("radix_sort"), "of lib\n"));
  CHECK(contains(gpu::program_source("flat"), "beside the folders\n"));
  CHECK_FALSE(message_of<DeviceError>([] { gpu::program_source("sort"); }).empty());
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
