// SPDX-License-Identifier: Apache-2.0
// A child that answers, fails, crashes, takes too much memory or time: each gives an answer or an error of its class,
// and the parent process continues.
#include "output/limited_child.hpp"
#include <doctest/doctest.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <vector>
#include "wavetracer/error.hpp"

using namespace wavetracer;
using Reply = LimitedChild::Reply;

namespace {

constexpr ChildLimits small{.bytes = uint64_t{64} << 20, .seconds = 1};

// A child that does what the word says.
void obey(std::string_view word, Reply& reply) {
  if (word == "fault") raise(SIGSEGV);
  if (word == "exit") _exit(0);
  if (word == "loop")
    for (volatile bool on = true; on;) {
    }
  if (word == "runtime") throw RuntimeError("a dataset is missing");
  if (word == "input") throw InputError("part.h5: a dataset is missing");
  if (word == "memory") reply.send(std::vector<char>(size_t{1} << 30).data(), 1);
  if (word == "other file") {
    reply.at_file("other.h5");
    raise(SIGSEGV);
  }
  reply.send(word.data(), word.size());
  reply.send("!", 1);
}

size_t open_files() {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

}  // namespace

TEST_CASE("a child answers one request after the other, of any size") {
  int asked = 0;
  LimitedChild child("run.h5", [&asked](std::string_view request, Reply& reply) {
    const std::vector<uint32_t> values = [&] {
      std::vector<uint32_t> out(std::stoul(std::string(request)));
      std::iota(out.begin(), out.end(), static_cast<uint32_t>(asked++));
      return out;
    }();
    reply.send(values.data(), values.size() * sizeof(uint32_t));
  });
  for (uint32_t i = 0; const size_t count : {size_t{0}, size_t{1}, size_t{3} << 20}) {
    const std::string bytes = child.request(std::to_string(count));
    REQUIRE(bytes.size() == count * sizeof(uint32_t));
    const auto* values = reinterpret_cast<const uint32_t*>(bytes.data());
    for (size_t k = 0; k < count; ++k) REQUIRE(values[k] == i + k);
    ++i;
  }
  CHECK(asked == 0);  // the child counted, not this process
}

TEST_CASE("errors of a child are thrown as what they are, and it goes on") {
  LimitedChild child("run.h5", obey, small);
  CHECK_THROWS_WITH_AS(child.request("runtime"), "a dataset is missing", RuntimeError);
  CHECK_THROWS_WITH_AS(child.request("input"), "part.h5: a dataset is missing", InputError);
  CHECK(child.request("word") == "word!");
// The sanitizers end a process that runs out of memory.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK_THROWS_WITH_AS(child.request("memory"), "reading it takes more than 64 MiB of memory", RuntimeError);
  CHECK(child.request("word") == "word!");
#endif
}

TEST_CASE("a child that faults, ends or loops is an input error that names its file, from then on") {
  const size_t before = open_files();
  for (const auto& [word, said] : {std::pair{"fault", "run.h5: the file is damaged: the HDF5 library fails on it"},
                                   {"exit", "run.h5: the file is damaged"},
                                   {"loop", "run.h5: reading it takes more than 1 s"},
                                   {"other file", "other.h5: the file is damaged"}}) {
    CAPTURE(word);
    LimitedChild child("run.h5", obey, small);
    CHECK(child.request("word") == "word!");
    CHECK_THROWS_WITH_AS(child.request(word), doctest::Contains(said), InputError);
    CHECK_THROWS_WITH_AS(child.request("word"), doctest::Contains(said), InputError);
  }
  CHECK(open_files() == before);
}

TEST_CASE("what an answer finds no room for ends the child") {
  LimitedChild child("run.h5", obey, small);
  CHECK_THROWS_AS(child.request("word", [](size_t) -> void* { throw std::bad_alloc(); }), InputError);
  CHECK_THROWS_AS(child.request("word"), InputError);
}

TEST_CASE("a child ends with the object, though another one was born while it lived") {
  auto first = std::make_unique<LimitedChild>("a.h5", obey, small);
  LimitedChild second("b.h5", obey, small);
  first.reset();  // returns only when the child has ended
  CHECK(second.request("word") == "word!");
}
