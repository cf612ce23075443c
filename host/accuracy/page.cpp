// SPDX-License-Identifier: Apache-2.0
// Makes the page, and writes the files: the table first, because the plot and the page are made from it.
#include "study/page.hpp"
#include <fmt/format.h>
#include <span>
#include "accuracy/advice.hpp"
#include "accuracy/files.hpp"
#include "accuracy/table.hpp"
#include "base/html_page.hpp"
#include "base/pending_file.hpp"
#include "base/xml_text.hpp"

namespace wavetracer::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr const char* style = "body{max-width:1320px}.own{background:#eef6fb}.reference{font-weight:bold}";

std::string table_html(const std::vector<Row>& rows) {
  std::string text = "<table>\n<thead><tr>" + html_cells(short_columns(), "th") + "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows)
    text += fmt::format("<tr class=\"{}{}\">{}</tr>\n", row.own ? "own " : "", row.reference ? "reference" : "",
                        html_cells(short_cells(row), "td"));
  return text + "</tbody>\n</table>\n";
}

std::string frames_text(const Study& study) {
  const std::string times = fmt::format(
      "the time of a frame is the median of warm frames, each solved {} times, "
      "once where it takes more than two seconds",
      study.repeats);
  if (!study.drive) return fmt::format("one frame with {} links; {}", study.links, times);
  return fmt::format("{} frames spread over the drive, {} links in all, each frame cold but for the rows of reuse; {}",
                     study.frames, study.links, times);
}

}  // namespace

std::string page_html(const Study& study, const std::string& command_line, const std::string& svg) {
  study::Heading heading = study::heading_of({}, study.device, command_line);
  heading.scene = study.scene;
  std::string text = fmt::format("<h1>Speed against error: {}</h1>\n{}<h2>What to set</h2>\n<ul>\n",
                                 xml_text(study.config_file), heading_html(heading, {frames_text(study)}));
  for (const std::string& item : recommendations(study)) text += fmt::format("<li>{}</li>\n", xml_text(item));
  text +=
      "</ul>\n<h2>Every setting</h2>\n<p>One axis changes at a time, everything else is as in the configuration. "
      "Losses and errors are against the reference of the axis, which is in bold; rays, auto and reuse share theirs. "
      "Gains are of links that have paths in both; the errors of spreads are means over these links. "
      "On the plot, settings that lose nothing lie at the bottom.</p>\n";
  return html_page("Speed against error", style, text + svg + table_html(study.rows));
}

Written write_files(const Study& study, const std::string& command_line, const fs::path& folder) {
  plots::Drawn drawn = plots::draw(front_figure(study), plots::Format::svg, folder);
  const std::string svg =
      drawn.problem.empty() ? study::inline_svg(study::file_text(drawn.files.back()), "accuracy-") : "";
  const std::string page = page_html(study, command_line, svg);
  std::vector<PendingFile> files;
  files.emplace_back(folder / "accuracy.html", std::as_bytes(std::span(page)));
  commit_together(files);
  drawn.files.push_back(files.front().path());
  return {drawn.files, drawn.problem};
}

}  // namespace wavetracer::accuracy
