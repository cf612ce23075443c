// SPDX-License-Identifier: Apache-2.0
// Pages of made-up runs, which the tests in a browser open: BUILD/tests/viewer/NAME/view.html.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include "base/file.hpp"
#include "folders.hpp"
#include "results/saved_run.hpp"
#include "viewer/view.hpp"

namespace wavetracer::test {

inline const std::filesystem::path folder = std::filesystem::path(build_folder()) / "tests" / "viewer";

inline ViewPage write_page(const std::string& name, const ViewOptions& options = {}) {
  ViewPage page = make_view(SavedRun(folder / name), options);
  write_file(folder / name / "view.html", page.html);
  return page;
}

inline nlohmann::json meta_of(const ViewPage& page) {
  const std::string begin = "<script type=\"application/json\" id=\"meta\">";
  const size_t from = page.html.find(begin) + begin.size();
  return nlohmann::json::parse(page.html.substr(from, page.html.find("</script>", from) - from));
}

}  // namespace wavetracer::test
