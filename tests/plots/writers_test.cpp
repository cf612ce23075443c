// SPDX-License-Identifier: Apache-2.0
// The writers that plots and pages share: tables as CSV, pages of HTML, text between their tags.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "base/csv_columns.hpp"
#include "base/html_page.hpp"
#include "base/xml_text.hpp"

using namespace wavetracer;

TEST_CASE("CSV: texts are quoted where they must be, numbers read back, rows have all cells") {
  CHECK(csv_field("a,\"b\"") == "\"a,\"\"b\"\"\"");
  CHECK(csv_field("two\nlines") == "\"two\nlines\"");
  CHECK(csv_field("plain") == "plain");
  Csv table({"name", "value", "count", "yes"});
  CHECK(table.text() == "name,value,count,yes\n");
  table.add("a,b", 0.1 + 0.2, 7u, true);
  table.add(std::string(), std::nan(""), -1, false);
  table.add_texts({"c", "", "\"", "4"});
  CHECK(table.text() == "name,value,count,yes\n\"a,b\",0.30000000000000004,7,1\n,nan,-1,0\nc,,\"\"\"\",4\n");
  CHECK_THROWS_AS(table.add("d", 1.0), std::logic_error);
  CHECK_THROWS_AS(table.add_texts({"d"}), std::logic_error);
}

TEST_CASE("CSV of columns: six digits, and texts that need quotes") {
  struct Point {
    std::string name;
    double x;
    bool on;
  };
  const Columns<Point> columns = {{"name", &Point::name}, {"x", &Point::x}, {"on", &Point::on}};
  CHECK(csv_of(columns, std::vector<Point>{{"a", 1.0 / 3, true}, {"b,c", 2, false}}).text() ==
        "name,x,on\na,0.333333,true\n\"b,c\",2,false\n");
}

TEST_CASE("pages of HTML: titles and cells are escaped, bodies and elements of the head are not") {
  const std::string page = html_page("a<b", "p{margin:0}", "<p>x</p>\n", "<meta name=\"y\">\n");
  CHECK(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"y\">\n"));
  CHECK(page.find("<title>a&lt;b</title>") != page.npos);
  CHECK(page.find("p{margin:0}</style>\n</head>\n<body>\n<p>x</p>\n</body>\n</html>\n") != page.npos);
  CHECK(html_cells({"<", "a & \"b\""}, "td") == "<td>&lt;</td><td>a &amp; &quot;b&quot;</td>");
}
