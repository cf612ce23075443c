// SPDX-License-Identifier: Apache-2.0
// Cells must not contain line ends.
#include "study/page.hpp"
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>
#include "base/html_page.hpp"
#include "base/xml_text.hpp"
#include "study/run.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string device_words(const DeviceSummary& device) {
  return fmt::format("{} ({}, driver {})", device.name, device.platform, device.driver);
}

std::string items_html(const std::vector<std::string>& items) {
  std::string text = "<ul class=\"about\">\n";
  for (const std::string& item : items) text += fmt::format("<li>{}</li>\n", item);
  return text + "</ul>\n";
}

}  // namespace

Heading heading_of(const Config& config, const DeviceSummary& device, const std::string& command_line) {
  const std::string& file = config.scene.file;
  return {.device = device,
          .scene = file.empty() ? "city " + config.scene.generate : fs::path(file).filename().string(),
          .command_line = command_line,
          .date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))};
}

Section section_of(const Experiment& experiment, const Findings& found) {
  return {.name = experiment.name,
          .title = experiment.title,
          .caption = experiment.caption,
          .words = found.words,
          .notes = found.notes};
}

std::string heading_markdown(const Heading& heading) {
  return fmt::format("- device: {}\n- scene: {}\n- date: {}, wavetracer {}\n- command: `{}`\n",
                     device_words(heading.device), heading.scene, heading.date, WAVETRACER_VERSION,
                     heading.command_line);
}

std::string page_markdown(const Section& section, const Heading& heading) {
  std::string text = fmt::format("# {}\n\n{}\n\n![{}]({}.svg)\n\n{}", section.title, words_text(section.words),
                                 section.caption, section.name, heading_markdown(heading));
  for (const std::string& note : section.notes) text += "- " + note + "\n";
  return text;
}

std::string verdict_cells(const Verdict& verdict) {
  std::string kind(word(verdict.outcome));
  std::ranges::replace(kind, ' ', '-');
  const std::string origin =
      verdict.origin == Origin::thesis ? "" : fmt::format(" <span class=\"origin\">{}</span>", word(verdict.origin));
  return fmt::format("<td>{}{}</td><td><span class=\"verdict {}\">{}</span></td><td>{}</td>", xml_text(verdict.claim),
                     origin, kind, word(verdict.outcome), xml_text(verdict.measured));
}

const char* verdict_style() {
  return ".words{margin-top:1em}.words td,.words th{text-align:left;vertical-align:top}"
         ".verdict{padding:1px 6px;border-radius:3px;white-space:nowrap}"
         ".exceeded{background:#1b7837;color:#fff}.reproduced{background:#a6dba0}.in-part{background:#ffe49c}"
         ".reproduced,.in-part,.refuted,.undecided{color:#222}"
         ".refuted{background:#f4a6a0}.undecided{background:#cfd8dc}"
         ".not-measured-there,.not-judged{background:#eee;color:#555}"
         ".origin{font-size:11px;color:#666;white-space:nowrap}"
         ".problem{color:#b00}";
}

std::string table_html(const NumberTable& table) {
  std::string text = table.caption.empty() ? "" : fmt::format("<p>{}</p>\n", xml_text(table.caption));
  text += "<div class=\"wide\"><table>\n<thead><tr>" + html_cells(table.heads, "th") + "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) text += "<tr>" + html_cells(row, "td") + "</tr>\n";
  return text + "</tbody>\n</table></div>\n";
}

std::string heading_html(const Heading& heading, const std::vector<std::string>& more) {
  std::vector<std::string> items = {"device: " + xml_text(device_words(heading.device)),
                                    "scene: " + xml_text(heading.scene)};
  for (const std::string& item : more) items.push_back(xml_text(item));
  items.push_back(fmt::format("date: {}, wavetracer {}", heading.date, WAVETRACER_VERSION));
  items.push_back(fmt::format("command: <code>{}</code>", xml_text(heading.command_line)));
  return items_html(items);
}

namespace {

std::string verdicts_table_html(const std::vector<Verdict>& verdicts) {
  std::string text =
      "<table class=\"words\">\n<thead><tr><th>claim</th><th>verdict</th><th>measured</th></tr></thead>\n<tbody>\n";
  for (const Verdict& verdict : verdicts) text += "<tr>" + verdict_cells(verdict) + "</tr>\n";
  return text + "</tbody>\n</table>\n";
}

}  // namespace

std::string section_html(const Section& section) {
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}: {}</h2>\n", section.name, section.name, xml_text(section.title));
  if (!section.problem.empty()) text += fmt::format("<p class=\"problem\">{}</p>\n", xml_text(section.problem));
  if (!section.words.paragraph.empty()) text += fmt::format("<p>{}</p>\n", xml_text(section.words.paragraph));
  if (!section.words.verdicts.empty()) text += verdicts_table_html(section.words.verdicts);
  text += section.svg;
  if (!section.words.numbers.rows.empty()) text += table_html(section.words.numbers);
  std::vector<std::string> notes;
  for (const std::string& note : section.notes) notes.push_back(xml_text(note));
  if (!notes.empty()) text += items_html(notes);
  return text + "<p><a href=\"#verdicts\">All verdicts</a></p>\n</section>\n";
}

std::string file_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string inline_svg(const std::string& document, const std::string& prefix) {
  const size_t begin = document.find("<svg");
  if (begin == std::string::npos) return "";
  std::string text = document.substr(begin);
  replace_all(text, "xmlns=\"http://www.w3.org/2000/svg\"", "");
  replace_all(text, "xmlns:xlink=\"http://www.w3.org/1999/xlink\"", "");
  replace_all(text, "id=\"", "id=\"" + prefix);
  replace_all(text, "id='", "id='" + prefix);
  replace_all(text, "xlink:href='#", "href='#" + prefix);
  replace_all(text, "url(#", "url(#" + prefix);
  return text;
}

}  // namespace wavetracer::study
