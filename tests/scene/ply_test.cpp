// SPDX-License-Identifier: Apache-2.0
// PLY: every dialect gives the same mesh, every kind of damage an error that names file and element.
// Files are built here byte by byte, independently of the writer.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "scene/ply.hpp"
#include "scene/polygon.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

void put(std::string& out, uint64_t bits, int bytes, bool big) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(bits >> (8 * (big ? bytes - 1 - i : i)) & 0xFF));
}

// A square with an extra scalar, an extra list and an element of its own between vertices and faces.
std::string binary_square(bool big) {
  std::string out =
      std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\r\ncomment odd\r\nobj_info none\r\nelement vertex 4\r\nproperty uchar red\r\nproperty double z\r\n"
      "property float32 x\r\nproperty short y\r\nelement camera 1\r\nproperty list uint8 float64 rows\r\n"
      "element face 1\r\nproperty list ushort int8 marks\r\nproperty list int uint vertex_index\r\n"
      "property float quality\r\nend_header\r\n";
  const float x[] = {0, 1.5f, 1.5f, 0};
  const int16_t y[] = {-2, -2, 3, 3};
  for (int i = 0; i < 4; ++i) {
    put(out, 200, 1, big);
    put(out, std::bit_cast<uint64_t>(0.1), 8, big);
    put(out, std::bit_cast<uint32_t>(x[i]), 4, big);
    put(out, static_cast<uint16_t>(y[i]), 2, big);
  }
  put(out, 2, 1, big);
  put(out, std::bit_cast<uint64_t>(1.0), 8, big);
  put(out, std::bit_cast<uint64_t>(2.0), 8, big);
  put(out, 3, 2, big);
  for (int i = 0; i < 3; ++i) put(out, 7, 1, big);
  put(out, 4, 4, big);
  for (uint32_t i = 0; i < 4; ++i) put(out, i, 4, big);
  put(out, std::bit_cast<uint32_t>(0.5f), 4, big);
  return out;
}

PlyMesh read(const std::string& content) {
  const test::TemporaryFolder folder;
  return read_ply(folder.write("mesh.ply", content));
}

double area(const PlyMesh& mesh) {  // signed area of triangles on z = 0
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 u = mesh.vertices[b] - mesh.vertices[a], v = mesh.vertices[c] - mesh.vertices[a];
    sum += (u.x * v.y - u.y * v.x) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("binary PLY of both byte orders with properties in any order") {
  for (bool big : {false, true}) {
    CAPTURE(big);
    const PlyMesh mesh = read(binary_square(big));
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[0] == glm::dvec3(0, -2, 0.1));
    CHECK(mesh.vertices[2] == glm::dvec3(1.5, 3, 0.1));
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(area(mesh) == 7.5);
  }
}

TEST_CASE("every cut of a binary PLY is an error") {
  const std::string whole = binary_square(false);
  for (size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    CHECK_THROWS_WITH_AS(read(whole.substr(0, size)), Contains("mesh.ply"), InputError);
  }
}

TEST_CASE("ascii PLY") {
  const PlyMesh mesh = read(test::square_ply("3 0 1 2\n4 3 2 1 0", 2));
  CHECK(mesh.triangles.size() == 3);
  CHECK(mesh.vertices[2] == glm::dvec3(1, 1, 0));
  CHECK(read(test::square_ply("2 0 1\n1 0\n3 0 1 2\n", 3)).small_faces == 2);
}

TEST_CASE("PLY: strips of triangles, elements that are not known, elements twice, bytes that are left over") {
  const auto with = [](const std::string& elements, const std::string& body) {
    const std::string square = test::square_ply("", 0);
    const size_t faces = square.find("element face"), end = square.find("end_header");
    return read(square.substr(0, faces) + elements + square.substr(end) + body);
  };
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  CHECK(with(strips, "10 0 1 3 2 -1 0 1 2 2 3\n").triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}, {0, 1, 2}});
  CHECK_THROWS_WITH_AS(with(strips, "3 0 1 9\n"), Contains("vertex index 9 is out of range"), InputError);
  CHECK_THROWS_WITH_AS(with(strips, "3 0 -2 1\n"), Contains("tristrips 0 of 1: vertex index -2"), InputError);
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const PlyMesh odd = with(face + "element patch 2\nproperty list uchar int corners\nelement edge 1\nproperty int a\n",
                           "3 0 1 2\n1 0\n2 0 1\n5\n");
  REQUIRE(odd.warnings.size() == 1);
  CHECK(odd.warnings[0].find("2 entries of the element 'patch' were left out") != std::string::npos);
  CHECK_THROWS_WITH_AS(with(face + face, "3 0 1 2\n3 0 2 3\n"), Contains("the element 'face' twice"), InputError);
  CHECK_THROWS_WITH_AS(
      with("element face 1\nproperty list uchar int vertex_index\nproperty list uchar int vertex_indices\n",
           "3 0 1 2 3 0 1 2\n"),
      Contains("has two lists of vertices"), InputError);
  const PlyMesh longer = with(face, "3 0 1 2\n3 0 2 3\n");
  REQUIRE(longer.warnings.size() == 1);
  CHECK(longer.warnings[0].find("8 bytes follow what the header declares") != std::string::npos);
  CHECK(with(face, "3 0 1 2\n \n\n").warnings.empty());
  CHECK(read("\xEF\xBB\xBF" + test::square_ply("3 0 1 2\n", 1)).triangles.size() == 1);
}

TEST_CASE("PLY errors name the element") {
  const auto fails = [](const std::string& content, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(read(content), Contains(message), InputError);
  };
  fails(test::square_ply("3 0 1 4\n", 1), "face 0 of 1: vertex index 4 is out of range, the file has 4 vertices");
  fails(test::square_ply("3 0 1 -1\n", 1), "face 0 of 1: vertex index -1 is out of range");
  fails(test::square_ply("3 0 1 1.5\n", 1), "'1.5' is not a whole number");
  fails(test::square_ply("3 0 1 2\n3 0 1\n", 2), "face 1 of 2: the file ends here");
  fails(test::square_ply("3 0 1 2\n", 4000000), "the header declares 4000000 entries of element 'face'");
  fails(test::square_ply("200 0 1 2\n", 1),
        "property 'vertex_indices' has the length 200, which is more than the file contains");
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n";
  const std::string z = "property float z\n", face = "element face 1\nproperty list uchar int vertex_indices\n";
  fails(head + z + face + "end_header\n0 nan 0\n3 0 0 0\n", "vertex 0 of 1: y is nan, not a finite number");
  fails(head + z + face + "end_header\n0 0 -inf\n3 0 0 0\n", "z is -inf, not a finite number");
  fails(head + z + face + "end_header\n0 0 zero\n3 0 0 0\n", "'zero' is not a number");
  fails(head + face + "end_header\n0 0\n3 0 0 0\n", "element 'vertex' needs the properties x, y and z");
  fails(head + z + "end_header\n0 0 0\n", "no element 'face'");
  fails(head + z + "element face 1\nproperty list uchar int corners\nend_header\n0 0 0\n3 0 0 0\n", "'vertex_indices'");
  fails(head + z + "element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n3 0 0 0\n",
        "integers");
  fails("ply\nformat ascii 1.0\n" + face + "end_header\n3 0 0 0\n", "no element 'vertex'");
  fails("ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
        "mesh.ply:3: element 'vertex' has the count 'many'");
  fails("ply\nformat ascii 1.0\nelement vertex 18446744073709551616\nend_header\n", "is not an integer");
  fails("ply\nformat binary 1.0\nend_header\n", "mesh.ply:2: unknown PLY format 'binary'");
  fails("ply\nformat ascii 2.0\nend_header\n", "mesh.ply:2: PLY of version 2.0 is not known");
  fails("ply\nelement vertex 1\nend_header\n", "no 'format' line");
  fails("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "before the first element");
  fails("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n", "unknown property type 'half'");
  fails("ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\nend_header\n", "integer type");
  fails("ply\nformat ascii 1.0\nlement vertex 1\nend_header\n", "mesh.ply:3: unknown header word 'lement'");
  fails("ply\nformat ascii 1.0\n", "no 'end_header'");
  fails("solid cube\n", "first line must be 'ply'");
  std::string huge = binary_square(false);
  huge.replace(huge.find("vertex 4"), 8, "vertex 4000000000");
  fails(huge, "the header declares 4000000000 entries of element 'vertex'");
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_ply(folder.path() / "none.ply"), Contains("no such file"), InputError);
  CHECK_THROWS_WITH_AS(read_ply(folder.path()), Contains("is a folder"), InputError);
}

TEST_CASE("concave polygons keep their area and winding") {
  const std::vector<glm::dvec3> points = {
      {0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}};  // an M upside down: 12 - 4
  for (uint32_t first = 0; first < 5; ++first) {
    CAPTURE(first);
    PlyMesh mesh;
    mesh.vertices = points;
    std::vector<uint32_t> polygon;
    for (uint32_t i = 0; i < 5; ++i) polygon.push_back((first + i) % 5);
    triangulate_polygon(mesh.vertices, polygon, mesh.triangles);
    REQUIRE(mesh.triangles.size() == 3);
    CHECK(area(mesh) == doctest::Approx(8).epsilon(1e-14));
    for (const Triangle& t : mesh.triangles) {
      PlyMesh one;
      one.vertices = points;
      one.triangles = {t};
      CHECK(area(one) > 0);
    }
  }
}

TEST_CASE("what the writer writes, the reader reads") {
  const std::vector<glm::dvec3> points = {{0.125, -7, 1e6}, {1, 2, 3}, {-4, 5, 6}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 0}};
  const PlyMesh mesh = read(format_ply(points, triangles));
  CHECK(mesh.vertices == points);
  CHECK(mesh.triangles == triangles);
}
