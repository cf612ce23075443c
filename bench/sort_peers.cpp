// SPDX-License-Identifier: Apache-2.0
// Wraps host sorts in one closure each, and reads a pipe from an external program.
// Closures share one array to sort in, so they must not run at the same time.
#include "sort_peers.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <tbb/parallel_sort.h>
#ifdef WAVETRACER_HWY
#include <hwy/contrib/sort/vqsort.h>
#endif

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "timing.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

template <class Key>
struct Pair {
  Key key;
  uint32_t value;
  bool operator<(const Pair& other) const { return key < other.key; }
};

template <class Record, class Key>
std::vector<Record> records_of(const std::vector<Key>& keys) {
  std::vector<Record> records(keys.size());
  for (size_t i = 0; i < keys.size(); i++) {
    if constexpr (std::is_same_v<Record, Key>) {
      records[i] = keys[i];
    } else {
      records[i].key = keys[i];
      records[i].value = static_cast<uint32_t>(i);
    }
  }
  return records;
}

// Makes peers that sort these records.
template <class Record>
class Maker {
 public:
  explicit Maker(std::vector<Record> records)
      : given_(std::make_shared<const std::vector<Record>>(std::move(records))),
        sorted_(std::make_shared<std::vector<Record>>()) {}

  template <class Sort>
  SortPeer operator()(const std::string& name, Sort sort) const {
    return {name, [name, sort, given = given_, sorted = sorted_] {
              *sorted = *given;
              const double seconds = wall_seconds([&] { sort(*sorted); });
              if (!std::is_sorted(sorted->begin(), sorted->end()))
                throw RuntimeError(fmt::format("{} left {} keys unsorted", name, sorted->size()));
              return seconds;
            }};
  }

 private:
  std::shared_ptr<const std::vector<Record>> given_;
  std::shared_ptr<std::vector<Record>> sorted_;
};

template <class Record>
void add_standard(std::vector<SortPeer>& peers, std::vector<Record> records, bool slow) {
  const Maker<Record> make(std::move(records));
  if (slow) {
    peers.push_back(make("std::sort, one thread", [](auto& r) { std::sort(r.begin(), r.end()); }));
    peers.push_back(make("std::stable_sort, one thread", [](auto& r) { std::stable_sort(r.begin(), r.end()); }));
  }
  peers.push_back(make("tbb::parallel_sort", [](auto& r) { tbb::parallel_sort(r.begin(), r.end()); }));
}

#ifdef WAVETRACER_HWY
template <class Record>
void add_vqsort(std::vector<SortPeer>& peers, std::vector<Record> records) {
  const auto sorter = std::make_shared<hwy::Sorter>();
  peers.push_back(Maker<Record>(std::move(records))(
      "hwy::VQSort, one thread", [sorter](auto& r) { (*sorter)(r.data(), r.size(), hwy::SortAscending()); }));
}
#endif

std::string word_of(const SortShape& shape) {
  return fmt::format("u{}:{}:{}:{}", shape.key_bits, shape.payload ? "pairs" : "keys", shape.n, shape.bits);
}

// Quotes any name for the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

}  // namespace

template <class Key>
std::vector<SortPeer> host_peers(const std::vector<Key>& keys, bool payload, bool slow) {
  std::vector<SortPeer> peers;
  if (payload)
    add_standard(peers, records_of<Pair<Key>>(keys), slow);
  else
    add_standard(peers, keys, slow);
#ifdef WAVETRACER_HWY
  using VqPair = std::conditional_t<sizeof(Key) == 4, hwy::K32V32, hwy::K64V64>;
  if (payload)
    add_vqsort(peers, records_of<VqPair>(keys));
  else
    add_vqsort(peers, keys);
#endif
  return peers;
}

template std::vector<SortPeer> host_peers(const std::vector<uint32_t>&, bool, bool);
template std::vector<SortPeer> host_peers(const std::vector<uint64_t>&, bool, bool);

ProgramTimes run_program(const std::string& program, const std::vector<SortShape>& shapes, size_t runs) {
  std::string command = quoted(program) + fmt::format(" {}", runs);
  for (const SortShape& shape : shapes) command += " " + word_of(shape);
  std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw RuntimeError(fmt::format("{} cannot be started", program));
  std::string text;
  char part[4096];
  while (const size_t length = std::fread(part, 1, sizeof part, pipe.get())) text.append(part, length);
  if (const int status = pclose(pipe.release()); status != 0)
    throw InputError(fmt::format("{} failed with exit code {}; is it bench/peers/cub_sort.cu, built for this GPU?",
                                 program, WIFEXITED(status) ? WEXITSTATUS(status) : -1));
  ProgramTimes times;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find('\n', start), text.size());
    const std::string line = text.substr(start, end - start);
    try {
      const auto json = nlohmann::json::parse(line);
      const SortShape shape{json.at("key") == "u64" ? 64u : 32u, json.at("payload"), json.at("n"), json.at("bits")};
      times[shape].emplace_back(json.at("sort"), json.at("seconds"));
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: {}; expected the lines of bench/peers/cub_sort.cu", program, error.what()));
    }
    start = end + 1;
  }
  return times;
}

}  // namespace wavetracer::bench
