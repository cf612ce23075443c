// The page and the order in which files are written: the table first, because the plot and the page are made of it.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <ctime>
#include <fstream>
#include <span>
#include <sstream>
#include "accuracy/advice.hpp"
#include "accuracy/files.hpp"
#include "accuracy/table.hpp"
#include "output/pending_file.hpp"
#include "study/thesis.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::accuracy {
namespace {

namespace fs = std::filesystem;
using study::escaped;

constexpr const char* style =
    "body{font:16px/1.5 sans-serif;max-width:1320px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;font-size:13px}td,th{border-bottom:1px solid #ddd;padding:2px 8px;text-align:right}"
    "td:nth-child(-n+3),th:nth-child(-n+3){text-align:left}svg{max-width:100%;height:auto}"
    ".own{background:#eef6fb}.reference{font-weight:bold}.about{font-size:13px;color:#555}";

std::string cells_html(const std::vector<std::string>& cells, const char* tag) {
  std::string text;
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text;
}

std::string table_html(const std::vector<Row>& rows) {
  std::string text = "<table>\n<thead><tr>" + cells_html(short_columns(), "th") + "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows)
    text += fmt::format("<tr class=\"{}{}\">{}</tr>\n", row.own ? "own " : "", row.reference ? "reference" : "",
                        cells_html(short_cells(row), "td"));
  return text + "</tbody>\n</table>\n";
}

std::string frames_text(const Study& study) {
  const std::string times = fmt::format(
      "the time of a frame is the median of warm frames, each solved {} times, once where it takes more than two "
      "seconds",
      study.repeats);
  if (!study.drive) return fmt::format("one frame with {} links; {}", study.links, times);
  return fmt::format("{} frames spread over the drive, {} links in all, each frame cold but for the rows of reuse; {}",
                     study.frames, study.links, times);
}

std::string file_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

std::string page_html(const Study& study, const std::string& command_line, const std::string& svg) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Speed against error</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<h1>Speed against error: {}</h1>\n<ul class=\"about\">\n<li>device: {} ({}, "
      "driver {})</li>\n<li>scene: {}</li>\n<li>{}</li>\n<li>date: {:%Y-%m-%d}, wavetracer {}</li>\n<li>command: "
      "<code>{}</code></li>\n</ul>\n",
      style, escaped(study.config_file), escaped(study.device.name), escaped(study.device.platform),
      escaped(study.device.driver), escaped(study.scene), escaped(frames_text(study)), fmt::gmtime(std::time(nullptr)),
      WAVETRACER_VERSION, escaped(command_line));
  text += "<h2>What to set</h2>\n<ul>\n";
  for (const std::string& item : recommendations(study)) text += fmt::format("<li>{}</li>\n", escaped(item));
  text +=
      "</ul>\n<h2>Every setting</h2>\n<p>One axis changes at a time, everything else is as in the configuration. "
      "Losses "
      "and errors are against the reference of the axis, which is in bold; rays, auto and reuse share theirs. Gains "
      "are "
      "of links that have paths in both; the errors of spreads are means over these links. On the plot, what loses "
      "nothing lies on the bottom.</p>\n";
  return text + svg + table_html(study.rows) + "</body>\n</html>\n";
}

Written write_files(const Study& study, const std::string& command_line, const fs::path& folder) {
  plots::Drawn drawn = plots::draw(front_figure(study), plots::Format::svg, folder);
  const std::string svg = drawn.problem.empty() ? study::inline_svg(file_text(drawn.files.back()), "accuracy-") : "";
  const std::string page = page_html(study, command_line, svg);
  std::vector<PendingFile> files;
  files.emplace_back(folder / "accuracy.html", std::as_bytes(std::span(page)));
  commit_together(files);
  drawn.files.push_back(files.front().path());
  return {drawn.files, drawn.problem};
}

}  // namespace wavetracer::accuracy
