// SPDX-License-Identifier: Apache-2.0
// Pages are one column of sans-serif text; tables are small, and drawings as wide as the page at most.
#include "base/html_page.hpp"
#include <fmt/format.h>
#include "base/xml_text.hpp"

namespace wavetracer {
namespace {

constexpr const char* style_of_pages =
    "body{font:16px/1.5 sans-serif;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;font-size:13px}"
    "td,th{border-bottom:1px solid #ddd;padding:2px 8px;text-align:right}"
    "td:nth-child(-n+3),th:nth-child(-n+3){text-align:left}"
    "svg{max-width:100%;height:auto}"
    ".wide{overflow-x:auto}h1,h2,code{overflow-wrap:anywhere}"
    ".about{font-size:13px;color:#555}"
    ":root{color-scheme:light dark}"
    "@media(prefers-color-scheme:dark){body{background:#161b24;color:#e8ecf2}td,th{border-color:#333d4c}"
    ".about{color:#9aa5b5}a{color:#5ad1ff}}";

}  // namespace

std::string html_page(const std::string& title, const std::string& style, const std::string& body,
                      const std::string& head) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}<title>{}</title>\n"
      "<style>{}{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      head, xml_text(title), style_of_pages, style, body);
}

std::string html_cells(const std::vector<std::string>& cells, const char* tag) {
  std::string text;
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, xml_text(cell));
  return text;
}

}  // namespace wavetracer
