// Host side of kernels/radix_sort.cl (groups) and kernels/radix_sort_cpu.cl (chunks), which have the same kernels.
// Assumes the layout of temporary memory of kernels/lib/radix.clh.
#include "passes/radix_sort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace wavetracer {

namespace {

constexpr uint32_t flag_words = 16;  // WT_MAX_PASSES
constexpr uint32_t line_words = 16;  // keys and values of the temporary memory begin at multiples of this

struct Form {
  const char* program;
  RadixLaunch launch;
  gpu::Definitions definitions;  // of this form alone
};

// Tile and columns: what 48 KiB of local memory hold, the fastest of some twenty on an H200; or 32 KiB.
Form groups_form(const gpu::DeviceInfo& device) {
  const bool large = device.local_memory >= 48 << 10;
  const uint32_t items = 256, columns = large ? 72 : 32, tile = 64 * columns;
  const uint32_t offset_items = large ? 256 : 32;
  return {.program = "radix_sort",
          .launch = {.digit_bits = 8,
                     .items = items,
                     .offset_items = offset_items,
                     .offset_groups = 256,  // a work-group a digit
                     .tile = tile,
                     .most_chunks = 1024,
                     .moves_tiles = true},
          .definitions = {{"WT_ITEMS", std::to_string(items)},
                          {"WT_TILE", std::to_string(tile)},
                          {"WT_OFFSET_ITEMS", std::to_string(offset_items)},
                          {"WT_COLUMNS", std::to_string(columns)}}};
}

// Eight chunks a core, because PoCL hands the first thread that comes half of all work-groups (and one) at once, the
// next half of the rest: the last ones level that out. Keys and values of 16 MiB still fit into the caches with the
// copy that they are moved to (measured with 32 MiB of third-level cache).
Form chunks_form(size_t pair_bytes, uint32_t cores, bool always_lines) {
  const size_t scatter_keys = always_lines ? 0 : (size_t{16} << 20) / pair_bytes;
  return {.program = "radix_sort_cpu",
          .launch = {.digit_bits = 8,
                     .items = 1,
                     .offset_items = 1,
                     .offset_groups = 1,
                     .tile = 1024,
                     .most_chunks = 8 * cores,
                     .moves_tiles = false},
          .definitions = {{"WT_SCATTER_KEYS", std::to_string(scatter_keys) + "u"}}};
}

uint32_t ceil_divide(uint32_t a, uint32_t b) { return a / b + (a % b != 0); }

void require(const char* what, size_t has, size_t needs, uint32_t n) {
  if (has >= needs) return;
  throw std::invalid_argument(
      fmt::format("radix_sort: {} has {} elements, {} are needed to sort {} keys", what, has, needs, n));
}

}  // namespace

template <class Key>
RadixSort<Key>::RadixSort(gpu::Context& context, Payload payload, SortForm form) : payload_(payload) {
  if (form == SortForm::device) form = context.info().cpu ? SortForm::chunks : SortForm::groups;
  Form f = form == SortForm::groups ? groups_form(context.info())
                                    : chunks_form(sizeof(Key) + (payload == Payload::none ? 0 : 4),
                                                  std::max(1u, context.info().compute_units), form == SortForm::lines);
  launch_ = f.launch;
  f.definitions["WT_KEY"] = sizeof(Key) == 4 ? "uint" : "ulong";
  f.definitions["WT_PAYLOAD"] = std::to_string(static_cast<int>(payload));
  f.definitions["WT_DIGIT_BITS"] = std::to_string(launch_.digit_bits);
  count_ = context.kernel(f.program, "count", f.definitions);
  offsets_ = context.kernel(f.program, "offsets", f.definitions);
  move_ = context.kernel(f.program, "move", f.definitions);
  settle_ = context.kernel(f.program, "settle", f.definitions);
}

template <class Key>
uint32_t RadixSort<Key>::chunk_of(uint32_t n) const {
  return launch_.tile * std::max(1u, ceil_divide(ceil_divide(n, launch_.tile), launch_.most_chunks));
}

template <class Key>
size_t RadixSort<Key>::temporary_words(uint32_t n) const {
  const size_t lines = (size_t{n} + line_words - 1) / line_words * line_words;
  const size_t tiles = launch_.moves_tiles ? ceil_divide(n, launch_.tile) : 0;
  // Not ceil(n / chunk): that may be more for fewer keys, and a buffer for n keys must do for them too.
  const size_t chunks = std::min(ceil_divide(n, launch_.tile), launch_.most_chunks);
  const size_t counts = (1 + chunks + tiles) << launch_.digit_bits;
  return flag_words + counts + lines * (sizeof(Key) / 4 + (payload_ == Payload::none ? 0 : 1));
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                                gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit,
                                const char* stage) {
  if (payload_ != Payload::none) require("values", values.size(), n, n);
  sort(keys, values, n, temporary, first_bit, end_bit, stage);
}

template <class Key>
void RadixSort<Key>::operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                                unsigned first_bit, unsigned end_bit, const char* stage) {
  if (payload_ != Payload::none) throw std::logic_error("radix_sort: a sort with a payload was given no values");
  sort(keys, temporary, n, temporary, first_bit, end_bit, stage);
}

template <class Key>
void RadixSort<Key>::sort(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n,
                          gpu::Buffer<uint32_t>& temporary, unsigned first_bit, unsigned end_bit, const char* stage) {
  if (first_bit > end_bit || end_bit > key_bits) {
    throw std::invalid_argument(
        fmt::format("radix_sort: bits {} to {} are no range of keys of {} bits", first_bit, end_bit, key_bits));
  }
  require("keys", keys.size(), n, n);
  require("temporary", temporary.size(), temporary_words(n), n);
  if (n <= 1) {
    if (n == 1 && payload_ == Payload::index) values.write(std::vector<uint32_t>{0}, 0, stage);
    return;
  }
  const uint32_t chunk = chunk_of(n);
  const size_t items = launch_.items;
  const gpu::Range chunks{items * ceil_divide(n, chunk), items};
  const gpu::Range moves{items * ceil_divide(n, launch_.moves_tiles ? launch_.tile : chunk), items};
  const uint32_t bits = end_bit - first_bit;
  const uint32_t passes = ceil_divide(bits, launch_.digit_bits);
  for (uint32_t pass = 0, shift = first_bit; pass < passes; ++pass) {
    const uint32_t width = bits / passes + (pass < bits % passes);
    const uint32_t mask = (1u << width) - 1;
    count_(chunks, stage, keys, temporary, n, chunk, pass, shift, mask);
    offsets_({size_t{launch_.offset_groups} * launch_.offset_items, launch_.offset_items}, stage, temporary, n, chunk,
             pass);
    move_(moves, stage, keys, values, temporary, n, chunk, pass, shift, mask);
    shift += width;
  }
  settle_(chunks, stage, keys, values, temporary, n, chunk, passes);
}

template class RadixSort<uint32_t>;
template class RadixSort<uint64_t>;

}  // namespace wavetracer
