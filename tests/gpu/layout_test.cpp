// SPDX-License-Identifier: Apache-2.0
// Every record of the headers that host and device share has the same size and the same offsets on both.
// The records and fields are read from the text of the headers, so that none is missing in the table
// (device_records.hpp).
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <map>
#include <regex>
#include <vector>
#include "folders.hpp"
#include "gpu/device_records.hpp"
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::vector<std::string> headers{"arguments.h",       "bvh.h",           "cache.h",    "curves.h",
                                       "field_arguments.h", "field_records.h", "moving.h",   "packed_rays.h",
                                       "points.h",          "records.h",       "waypoints.h"};

// Record name -> field names, as the headers declare them.
std::map<std::string, std::vector<std::string>> declared_records() {
  std::map<std::string, std::vector<std::string>> declared;
  const std::regex comment("//[^\n]*"), record("typedef struct \\{([^}]*)\\} (\\w+);"),
      field("(\\w+)\\s*(\\[[^;]*\\])?[,;]");
  for (const std::string& header : headers) {
    const std::string text =
        std::regex_replace(read_file(test::source_folder() + "/include/wavetracer/device/" + header), comment, "");
    for (std::sregex_iterator r(text.begin(), text.end(), record), end; r != end; ++r) {
      const std::string body = (*r)[1];
      for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) declared[(*r)[2]].push_back((*f)[1]);
    }
  }
  return declared;
}

}  // namespace

TEST_CASE("the table names every record and field of the headers, in order") {
  std::map<std::string, std::vector<std::string>> listed;
  for (const Record& record : records) {
    for (const Field& field : record.fields) listed[record.name].push_back(field.name);
  }
  CHECK(listed == declared_records());
}

TEST_CASE("sizes and offsets agree between host and device") {
  std::string body;
  std::vector<uint32_t> expected;
  const auto expect = [&](const std::string& expression, size_t value) {
    body += fmt::format("  out[{}] = (uint)({});\n", expected.size(), expression);
    expected.push_back(static_cast<uint32_t>(value));
  };
  for (const Record& record : records) {
    body += fmt::format("  {0} a_{0};\n", record.name);
    expect(fmt::format("sizeof({})", record.name), record.bytes);
    for (const Field& field : record.fields) {
      expect(fmt::format("(private char*)&a_{0}.{1} - (private char*)&a_{0}", record.name, field.name), field.offset);
    }
  }
  const TemporaryKernels kernels;
  std::string includes;
  for (const std::string& header : headers) includes += "#include \"wavetracer/device/" + header + "\"\n";
  kernels.add("layout.cl", includes + "kernel void layout(global uint* out) {\n" + body + "}\n");
  gpu::Context context;
  auto out = context.buffer<uint32_t>(expected.size(), "out");
  context.kernel("layout", "layout")({1, 1}, Stage::transfer, out);
  CHECK(out.read() == expected);
}
