// SPDX-License-Identifier: Apache-2.0
// A request is a record and the name of a dataset; an answer is the bytes of its values.
// Rows come in blocks, so the child holds one block, and reads the next one while this process takes the last.
#include "output/foreign_file.hpp"
#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include "output/hdf5_read.hpp"
#include "output/limited_child.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::hdf5 {
namespace {

enum class Asked : uint32_t { shape, bytes, words, longs, doubles, strings, root_text, root_number, group };

struct Question {
  Asked asked = Asked::shape;
  uint32_t inner_count = 0;
  std::array<uint64_t, 3> inner{};
  uint64_t first = 0, count = 0;  // rows to read
};

constexpr uint64_t to_the_end = ~uint64_t{0};  // as a count: all rows, from row 0 on
constexpr uint64_t block_bytes = uint64_t{1} << 20;

template <typename T>
constexpr Asked numbers_of() {
  if constexpr (std::is_same_v<T, uint8_t>) return Asked::bytes;
  if constexpr (std::is_same_v<T, uint32_t>) return Asked::words;
  if constexpr (std::is_same_v<T, uint64_t>) return Asked::longs;
  if constexpr (std::is_same_v<T, double>) return Asked::doubles;
}

Question question(Asked asked, const std::vector<uint64_t>& inner = {}, uint64_t first = 0, uint64_t count = 0) {
  Question out{asked, static_cast<uint32_t>(inner.size()), {}, first, count};
  if (inner.size() > out.inner.size()) throw RuntimeError("a dataset of more dimensions than can be read is asked for");
  std::ranges::copy(inner, out.inner.begin());
  return out;
}

// The child's side.
class Reader {
 public:
  explicit Reader(std::filesystem::path path) : path_(std::move(path)) {}

  void answer(std::string_view request, LimitedChild::Reply& reply) {
    if (!file_) file_.reset(new File(File::open_to_read(path_)));
    Question q;
    std::memcpy(&q, request.data(), sizeof q);
    const std::string name(request.substr(sizeof q));
    const std::vector<hsize_t> inner(q.inner.begin(), q.inner.begin() + q.inner_count);
    switch (q.asked) {
      case Asked::shape: {
        const std::vector<hsize_t> shape = NumberColumn<double>(*file_, name, inner).shape();
        return reply.send(shape.data(), shape.size() * sizeof shape[0]);
      }
      case Asked::bytes:
        return send_rows<uint8_t>(q, name, inner, reply);
      case Asked::words:
        return send_rows<uint32_t>(q, name, inner, reply);
      case Asked::longs:
        return send_rows<uint64_t>(q, name, inner, reply);
      case Asked::doubles:
        return send_rows<double>(q, name, inner, reply);
      case Asked::strings: {
        std::string all;
        for (const std::string& text : read_strings(*file_, name)) all += text + '\0';
        return reply.send(all.data(), all.size());
      }
      case Asked::root_text: {
        const std::string text = hdf5::root_text(*file_, name);
        return reply.send(text.data(), text.size());
      }
      case Asked::group: {
        const char there = H5Lexists(file_->id(), name.c_str(), H5P_DEFAULT) > 0 ? 'y' : 'n';
        return reply.send(&there, 1);
      }
      case Asked::root_number: {
        const double number = hdf5::root_number(*file_, name);
        return reply.send(&number, sizeof number);
      }
    }
  }

 private:
  template <typename T>
  void send_rows(const Question& q, const std::string& name, const std::vector<hsize_t>& inner,
                 LimitedChild::Reply& reply) const {
    const NumberColumn<T> column(*file_, name, inner);
    const hsize_t count = q.count == to_the_end ? column.rows() - q.first : q.count;
    column.check_rows(q.first, count);
    const hsize_t some = std::max<hsize_t>(1, block_bytes / sizeof(T) / std::max<hsize_t>(1, column.row_values()));
    for (hsize_t done = 0; done < count; done += some) {
      const std::vector<T> values = column.read(q.first + done, std::min(some, count - done));
      reply.send(values.data(), values.size() * sizeof(T));
    }
  }

  std::filesystem::path path_;
  std::unique_ptr<File> file_;
};

}  // namespace

struct ForeignFile::Child {
  mutable LimitedChild process;

  explicit Child(const std::filesystem::path& path)
      : process(path.string(),
                [reader = std::make_shared<Reader>(path)](std::string_view request, LimitedChild::Reply& reply) {
                  reader->answer(request, reply);
                }) {}

  static std::string packed(const Question& q, const std::string& name) {
    return std::string(reinterpret_cast<const char*>(&q), sizeof q) + name;
  }
  std::string ask(const Question& q, const std::string& name) { return process.request(packed(q, name)); }

  // expected: the number of values, 0 if it is unknown.
  template <typename T>
  std::vector<T> numbers(const Question& q, const std::string& name, uint64_t expected) {
    std::vector<T> out;
    process.request(packed(q, name), [&](size_t bytes) -> void* {
      if (bytes % sizeof(T) != 0) throw RuntimeError(name + " ends in the middle of a number");
      if (out.empty()) out.reserve(expected);
      const size_t before = out.size();
      out.resize(before + bytes / sizeof(T));
      return out.data() + before;
    });
    if (expected != 0 && out.size() != expected) throw RuntimeError(name + " has fewer rows than it says");
    return out;
  }
};

ForeignFile::ForeignFile(const std::filesystem::path& path) : child_(std::make_unique<Child>(path)) {}
ForeignFile::~ForeignFile() = default;
ForeignFile::ForeignFile(ForeignFile&&) noexcept = default;

bool ForeignFile::has(const std::string& group) const { return child_->ask(question(Asked::group), group) == "y"; }

std::vector<uint64_t> ForeignFile::shape(const std::string& dataset, const std::vector<uint64_t>& inner) const {
  return child_->numbers<uint64_t>(question(Asked::shape, inner), dataset, inner.size() + 1);
}

template <typename T>
std::vector<T> ForeignFile::rows(const std::string& dataset, uint64_t first, uint64_t count,
                                 const std::vector<uint64_t>& inner) const {
  uint64_t values = count;
  for (const uint64_t n : inner)
    if (__builtin_mul_overflow(values, n, &values)) throw RuntimeError(dataset + " is too large");
  return child_->numbers<T>(question(numbers_of<T>(), inner, first, count), dataset, values);
}

template <typename T>
std::vector<T> ForeignFile::all_rows(const std::string& dataset, const std::vector<uint64_t>& inner) const {
  return child_->numbers<T>(question(numbers_of<T>(), inner, 0, to_the_end), dataset, 0);
}

template std::vector<uint8_t> ForeignFile::rows(const std::string&, uint64_t, uint64_t,
                                                const std::vector<uint64_t>&) const;
template std::vector<uint32_t> ForeignFile::rows(const std::string&, uint64_t, uint64_t,
                                                 const std::vector<uint64_t>&) const;
template std::vector<uint64_t> ForeignFile::rows(const std::string&, uint64_t, uint64_t,
                                                 const std::vector<uint64_t>&) const;
template std::vector<double> ForeignFile::rows(const std::string&, uint64_t, uint64_t,
                                               const std::vector<uint64_t>&) const;
template std::vector<uint32_t> ForeignFile::all_rows(const std::string&, const std::vector<uint64_t>&) const;
template std::vector<uint64_t> ForeignFile::all_rows(const std::string&, const std::vector<uint64_t>&) const;
template std::vector<double> ForeignFile::all_rows(const std::string&, const std::vector<uint64_t>&) const;

std::vector<std::string> ForeignFile::strings(const std::string& dataset) const {
  const std::string all = child_->ask(question(Asked::strings), dataset);
  std::vector<std::string> out;
  for (size_t at = 0, end; at < all.size() && (end = all.find('\0', at)) != std::string::npos; at = end + 1)
    out.push_back(all.substr(at, end - at));
  return out;
}

std::string ForeignFile::root_text(const std::string& name) const {
  return child_->ask(question(Asked::root_text), name);
}

double ForeignFile::root_number(const std::string& name) const {
  return child_->numbers<double>(question(Asked::root_number), name, 1)[0];
}

}  // namespace wavetracer::hdf5
