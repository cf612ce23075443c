// Fuzz target: well-formed containers whose numbers come from the input, as view, plot and convert read them.
// An input is a row of patches, 11 bytes each: the dataset, the element (16 bits), its value. No process is started for
// the reading, since the library itself meets nothing but files that it has written.
#include <cstring>
#include <fstream>
#include <iterator>
#include "fuzz/fuzz.hpp"
#include "output/hdf5_read.hpp"
#include "output/sample_run.hpp"
#include "results/saved_run.hpp"

void wavetracer::hdf5::rehearse(const std::function<void()>&) {}

namespace {

using namespace wavetracer;
using hdf5::Id;

constexpr size_t patch_bytes = 11;

std::string sample_file() {
  const SampleRun sample;
  const std::filesystem::path folder = "/dev/shm/wavetracer-fuzz-sample-" + std::to_string(getpid());
  write_outputs(folder, sample.run(), sample.frames());
  std::ifstream in(folder / "paths.h5", std::ios::binary);
  const std::string content(std::istreambuf_iterator<char>(in), {});
  std::filesystem::remove_all(folder);
  return content;
}

std::vector<std::string> number_datasets(const std::filesystem::path& file) {
  std::vector<std::string> names;
  const Id h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the sample");
  const auto add = [](hid_t root, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const Id dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose, "open a dataset");
    const Id type(H5Dget_type(dataset), H5Tclose, "read a type");
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_INTEGER || kind == H5T_FLOAT) static_cast<std::vector<std::string>*>(out)->push_back(name);
    return 0;
  };
  hdf5::checked(H5Ovisit2(h5, H5_INDEX_NAME, H5_ITER_INC, add, &names, H5O_INFO_BASIC), "visit the sample");
  return names;
}

void patch(hid_t h5, const std::string& name, size_t element, const uint8_t* value) {
  const Id dataset(H5Dopen2(h5, name.c_str(), H5P_DEFAULT), H5Dclose, "open a dataset");
  const Id type(H5Dget_type(dataset), H5Tclose, "read a type");
  const Id space(H5Dget_space(dataset), H5Sclose, "read a shape");
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count <= 0) return;
  std::vector<char> values(static_cast<size_t>(count) * H5Tget_size(type));
  hdf5::checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read a dataset");
  std::memcpy(values.data() + element % static_cast<size_t>(count) * H5Tget_size(type), value, H5Tget_size(type));
  hdf5::checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write a dataset");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string sample = sample_file();
  static fuzz::MemoryFile file("paths.h5");
  file.write(sample);
  static const std::vector<std::string> names = number_datasets(file.path());
  if (size >= patch_bytes) {
    const Id h5(H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open the sample");
    for (; size >= patch_bytes; data += patch_bytes, size -= patch_bytes)
      patch(h5, names[data[0] % names.size()], size_t{data[1]} + 256 * size_t{data[2]}, data + 3);
  }
  return fuzz::accept_or_refuse([&] {
    const SavedRun run(file.path());
    for (size_t row = 0; row < run.frame_count(); ++row) {
      const SavedFrame frame = run.frame(row);
      for (const uint32_t tx : frame.paths.tx)
        if (tx >= run.transmitters().size()) std::abort();
      for (const SavedPose& pose : frame.poses)
        if (pose.instance >= run.instances().size()) std::abort();
      if (frame.paths.vertex_offset.back() != frame.paths.vertex_position_m.size()) std::abort();
    }
  });
}
