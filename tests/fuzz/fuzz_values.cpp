// SPDX-License-Identifier: Apache-2.0
// Fuzz target: well-formed containers whose numbers and lengths come from the input, as view, plot and convert read
// them. An input is a row of patches, 11 bytes each: the dataset, the element (16 bits), its value; of datasets from
// 128 on the value's first byte is the number of rows instead. A reader of datasets in memory replaces
// output/foreign_file.cpp: the library would take a hundred times as long.
#include <algorithm>
#include <cstring>
#include <unordered_map>
#include "fuzz/fuzz.hpp"
#include "output/foreign_file.hpp"
#include "output/hdf5.hpp"
#include "output/sample_run.hpp"
#include "results/saved_run.hpp"

namespace {

using namespace wavetracer;
using hdf5::Id;

constexpr size_t patch_bytes = 11;

struct Dataset {
  std::vector<hsize_t> shape;
  size_t value_bytes;
  std::vector<char> values;

  size_t row_bytes() const {
    size_t bytes = value_bytes;
    for (size_t i = 1; i < shape.size(); ++i) bytes *= shape[i];
    return bytes;
  }
};

struct Container {
  std::unordered_map<std::string, Dataset> numbers;
  std::unordered_map<std::string, std::vector<std::string>> texts;
};

Dataset numbers_in(hid_t dataset, hid_t type) {
  const Id space(H5Dget_space(dataset), H5Sclose, "read a shape");
  Dataset out{std::vector<hsize_t>(static_cast<size_t>(H5Sget_simple_extent_ndims(space))), H5Tget_size(type), {}};
  H5Sget_simple_extent_dims(space, out.shape.data(), nullptr);
  out.values.resize(out.shape[0] * out.row_bytes());
  hdf5::checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.values.data()), "read numbers");
  return out;
}

std::vector<std::string> texts_in(hid_t dataset, hid_t type) {
  const Id space(H5Dget_space(dataset), H5Sclose, "read a shape");
  std::vector<char*> values(static_cast<size_t>(H5Sget_simple_extent_npoints(space)));
  hdf5::checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read texts");
  std::vector<std::string> out(values.begin(), values.end());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, values.data());
  return out;
}

herr_t add_dataset(hid_t root, const char* name, const H5O_info_t* info, void* out) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  auto& container = *static_cast<Container*>(out);
  const Id dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose, "open a dataset");
  const Id type(H5Dget_type(dataset), H5Tclose, "read a type");
  const std::string path = std::string("/") + name;
  if (H5Tget_class(type) == H5T_STRING)
    container.texts[path] = texts_in(dataset, type);
  else if (H5Tget_class(type) == H5T_INTEGER || H5Tget_class(type) == H5T_FLOAT)
    container.numbers[path] = numbers_in(dataset, type);
  return 0;
}

// paths.h5 of the sample, which is never changed: SavedRun gets its path, though nothing is read from it.
class Sample {
 public:
  Sample() : folder_("/dev/shm/wavetracer-fuzz-sample-" + std::to_string(getpid())) {
    const SampleRun sample;
    write_outputs(folder_, sample.run(), sample.frames());
    const hdf5::File open = hdf5::File::open_to_read(file());
    hdf5::checked(H5Ovisit2(open.id(), H5_INDEX_NAME, H5_ITER_INC, add_dataset, &content_, H5O_INFO_BASIC), "visit");
  }
  ~Sample() { std::filesystem::remove_all(folder_); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;
  std::filesystem::path file() const { return folder_ / "paths.h5"; }
  const Container& content() const { return content_; }

 private:
  std::filesystem::path folder_;
  Container content_;
};

Container patched;

std::vector<std::string> sorted_names(const Container& container) {
  std::vector<std::string> names;
  for (const auto& [name, dataset] : container.numbers) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

void patch(Dataset& dataset, bool rows, size_t element, const uint8_t* value) {
  if (rows) {
    dataset.shape[0] = value[0] % 8;
    dataset.values.resize(dataset.shape[0] * dataset.row_bytes());
  } else if (const size_t count = dataset.values.size() / dataset.value_bytes; count > 0) {
    std::memcpy(dataset.values.data() + element % count * dataset.value_bytes, value, dataset.value_bytes);
  }
}

void read_all(const std::filesystem::path& file) {
  const SavedRun run(file);
  for (size_t row = 0; row < run.frame_count(); ++row) {
    const SavedFrame frame = run.frame(row);
    for (const uint32_t tx : frame.paths.tx)
      if (tx >= run.transmitters().size()) std::abort();
    for (const SavedPose& pose : frame.poses)
      if (pose.instance >= run.instances().size()) std::abort();
    if (frame.paths.vertex_offset.back() != frame.paths.vertex_position_m.size()) std::abort();
  }
}

}  // namespace

namespace wavetracer::hdf5 {

struct ForeignFile::Child {};

ForeignFile::ForeignFile(const std::filesystem::path&) {}
ForeignFile::~ForeignFile() = default;

bool ForeignFile::has(const std::string& group) const {
  const auto within = [&](const auto& entry) { return entry.first.starts_with(group + "/"); };
  return std::ranges::any_of(patched.numbers, within) || std::ranges::any_of(patched.texts, within);
}

std::vector<uint64_t> ForeignFile::shape(const std::string& path, const std::vector<uint64_t>& inner) const {
  const Dataset& dataset = patched.numbers.at(path);
  if (dataset.shape.size() != inner.size() + 1) std::abort();
  for (size_t i = 0; i < inner.size(); ++i)
    if (inner[i] != 0 && dataset.shape[i + 1] != inner[i]) throw RuntimeError(path + " has another shape");
  return {dataset.shape.begin(), dataset.shape.end()};
}

template <typename T>
std::vector<T> ForeignFile::rows(const std::string& path, uint64_t first, uint64_t count,
                                 const std::vector<uint64_t>& inner) const {
  const uint64_t there = shape(path, inner)[0];
  const Dataset& dataset = patched.numbers.at(path);
  if (dataset.value_bytes != sizeof(T)) std::abort();
  if (first > there || count > there - first) throw RuntimeError(path + " has too few rows");
  std::vector<T> out(count * dataset.row_bytes() / sizeof(T));
  if (!out.empty())
    std::memcpy(out.data(), dataset.values.data() + first * dataset.row_bytes(), out.size() * sizeof(T));
  return out;
}

template <typename T>
std::vector<T> ForeignFile::all_rows(const std::string& path, const std::vector<uint64_t>& inner) const {
  return rows<T>(path, 0, shape(path, inner)[0], inner);
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

std::vector<std::string> ForeignFile::strings(const std::string& path) const { return patched.texts.at(path); }
std::string ForeignFile::root_text(const std::string& name) const {
  return name == "format" ? "wavetracer paths" : name;
}
double ForeignFile::root_number(const std::string&) const { return 1; }

}  // namespace wavetracer::hdf5

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const Sample sample;
  static const std::vector<std::string> names = sorted_names(patched = sample.content());
  for (const uint8_t* p = data; p + patch_bytes <= data + size; p += patch_bytes)
    patch(patched.numbers.at(names[p[0] % 128 % names.size()]), p[0] >= 128, size_t{p[1]} + 256 * size_t{p[2]}, p + 3);
  fuzz::accept_or_refuse([&] { read_all(sample.file()); });
  for (const uint8_t* p = data; p + patch_bytes <= data + size; p += patch_bytes) {
    const std::string& name = names[p[0] % 128 % names.size()];
    patched.numbers.at(name) = sample.content().numbers.at(name);
  }
  return 0;
}
