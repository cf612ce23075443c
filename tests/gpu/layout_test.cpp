// Every record of include/wavetracer/device/records.h has the same size and the same offsets on the device and here.
// The header's own text says which records and fields there are, so that none is left out of the table below.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <cstddef>
#include <map>
#include <regex>
#include <vector>
#include "gpu/gpu.hpp"
#include "gpu/temporary.hpp"
#include "wavetracer/device/records.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Field {
  const char* name;
  size_t offset;
};
struct Record {
  const char* name;
  size_t bytes;
  std::vector<Field> fields;
};

#define FIELD(record, field) \
  { #field, offsetof(record, field) }

const std::vector<Record> records{
    {"wt_surface",
     sizeof(wt_surface),
     {FIELD(wt_surface, normal), FIELD(wt_surface, offset), FIELD(wt_surface, lower), FIELD(wt_surface, upper)}},
    {"wt_exact_surface",
     sizeof(wt_exact_surface),
     {FIELD(wt_exact_surface, normal), FIELD(wt_exact_surface, offset), FIELD(wt_exact_surface, first_triangle),
      FIELD(wt_exact_surface, triangle_count), FIELD(wt_exact_surface, instance), FIELD(wt_exact_surface, padding)}},
    {"wt_model_surface",
     sizeof(wt_model_surface),
     {FIELD(wt_model_surface, normal), FIELD(wt_model_surface, offset), FIELD(wt_model_surface, lower),
      FIELD(wt_model_surface, upper), FIELD(wt_model_surface, first_triangle),
      FIELD(wt_model_surface, triangle_count)}},
    {"wt_exact_instance",
     sizeof(wt_exact_instance),
     {FIELD(wt_exact_instance, rotation), FIELD(wt_exact_instance, position), FIELD(wt_exact_instance, first_surface),
      FIELD(wt_exact_instance, first_model_surface), FIELD(wt_exact_instance, present),
      FIELD(wt_exact_instance, padding)}},
    {"wt_candidate",
     sizeof(wt_candidate),
     {FIELD(wt_candidate, node), FIELD(wt_candidate, receiver), FIELD(wt_candidate, back)}},
    {"wt_solved",
     sizeof(wt_solved),
     {FIELD(wt_solved, transmitter), FIELD(wt_solved, receiver), FIELD(wt_solved, depth), FIELD(wt_solved, blocked),
      FIELD(wt_solved, node)}},
    {"wt_counters",
     sizeof(wt_counters),
     {FIELD(wt_counters, nodes), FIELD(wt_counters, trie_overflow), FIELD(wt_counters, candidates),
      FIELD(wt_counters, solved), FIELD(wt_counters, visible)}},
};

#undef FIELD

// Record name -> field names, as the header declares them.
std::map<std::string, std::vector<std::string>> declared_records() {
  std::string text = read_file(WAVETRACER_SOURCE "/include/wavetracer/device/records.h");
  text = std::regex_replace(text, std::regex("//[^\n]*"), "");
  std::map<std::string, std::vector<std::string>> declared;
  const std::regex record("typedef struct \\{([^}]*)\\} (\\w+);"), field("(\\w+)\\s*(\\[[^;]*\\])?;");
  for (std::sregex_iterator r(text.begin(), text.end(), record), end; r != end; ++r) {
    const std::string body = (*r)[1];
    for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) declared[(*r)[2]].push_back((*f)[1]);
  }
  return declared;
}

}  // namespace

TEST_CASE("the table names every record and field of the header, in order") {
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
  kernels.add("layout.cl",
              "#include \"wavetracer/device/records.h\"\nkernel void layout(global uint* out) {\n" + body + "}\n");
  gpu::Context context;
  auto out = context.buffer<uint32_t>(expected.size(), "out");
  context.kernel("layout", "layout")({1, 1}, "test", out);
  CHECK(out.read() == expected);
}
