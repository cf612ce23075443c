// SPDX-License-Identifier: Apache-2.0
// Every kernel runs in a check of devices, or docs/design/device_check.md has a row that says why it does not.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "folders.hpp"
#include "simulation/device_check.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  REQUIRE(out.str() != "");
  return out.str();
}

std::set<std::string> found_in(const std::string& text, const std::regex& pattern) {
  std::set<std::string> out;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) out.insert((*at)[1]);
  return out;
}

// The kernels of all sources, "program/kernel".
std::set<std::string> all_kernels() {
  const std::regex pattern(R"(\bkernel (?:__attribute__\(\(.*?\)\)\) )?void (\w+)\()");
  std::set<std::string> out;
  for (const auto& file : fs::recursive_directory_iterator(fs::path(test::source_folder()) / "kernels"))
    if (file.path().extension() == ".cl")
      for (const std::string& kernel : found_in(text_of(file.path()), pattern))
        out.insert(file.path().stem().string() + "/" + kernel);
  REQUIRE(out.size() > 100);
  return out;
}

// The kernels that the table of the page names, and the devices on which they need not run.
std::map<std::string, std::string> excused_kernels() {
  const std::string page = text_of(fs::path(test::source_folder()) / "docs/design/device_check.md");
  const std::regex row(R"(\| (`[^|]*`) \| (all|some|CPUs|GPUs) \| [^|]+ \|)"), name("`([^`]*)`");
  std::map<std::string, std::string> out;
  for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at)
    for (const std::string& kernel : found_in((*at)[1], name)) out[kernel] = (*at)[2];
  REQUIRE(out.size() > 3);
  return out;
}

}  // namespace

TEST_CASE("every kernel is checked, or the page says why it is not") {
  gpu::Context context;
  const std::string here = context.info().cpu ? "CPUs" : "GPUs";
  std::set<std::string> ran;
  for (const CheckedFeatures& features : all_checked_features())
    for (const CheckResult& result : check_device(context, features, &ran)) {
      INFO(features.words() << ": " << result.name << ": " << result.found);
      CHECK(result.passed);
    }
  const std::set<std::string> all = all_kernels();
  const std::map<std::string, std::string> excused = excused_kernels();
  for (const std::string& kernel : all) {
    CAPTURE(kernel);
    const auto row = excused.find(kernel);
    const std::string devices = row == excused.end() ? "" : row->second;
    if (!ran.contains(kernel) && devices != "all" && devices != "some" && devices != here)
      FAIL_CHECK("no check runs it: give CheckedFeatures what chooses it, or add a row to docs/design/device_check.md");
    if (ran.contains(kernel) && devices == "all")
      FAIL_CHECK("a check runs it: remove it from docs/design/device_check.md");
  }
  for (const auto& [kernel, devices] : excused) {
    CAPTURE(kernel);
    CHECK(all.contains(kernel));  // else the page names a kernel that is not there
  }
}
