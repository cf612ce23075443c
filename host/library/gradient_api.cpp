// SPDX-License-Identifier: Apache-2.0
// The functions of gradient.h.
#include <algorithm>
#include <complex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include "library/column_view.hpp"
#include "library/handles.hpp"
#include "wavetracer/gradient.h"
#include "wavetracer/gradient.hpp"

struct wavetracer_gradient {
  wavetracer::PathGradients of;
  size_t ports;
  std::vector<uint8_t> parameter, gap;
  std::vector<std::complex<double>> a;  // packed: only ports that exist
};

namespace wavetracer::c_api {
namespace {

static_assert(static_cast<int>(PathParameter::most_attenuation) == WAVETRACER_MOST_ATTENUATION &&
              static_cast<int>(PathParameter::tx_x) == WAVETRACER_TX_POSITION &&
              static_cast<int>(PathParameter::rx_x) == WAVETRACER_RX_POSITION &&
              static_cast<int>(PathParameter::tx_turn_x) == WAVETRACER_TX_TURN &&
              static_cast<int>(PathParameter::rx_turn_x) == WAVETRACER_RX_TURN);
static_assert(static_cast<int>(GradientGap::not_solved) == WAVETRACER_GAP_NOT_SOLVED &&
              static_cast<int>(GradientGap::pole) == WAVETRACER_GAP_POLE &&
              static_cast<int>(GradientGap::singular) == WAVETRACER_GAP_SINGULAR &&
              static_cast<int>(GradientGap::jump) == WAVETRACER_GAP_JUMP);

GradientChoice choice_of(const char* function, unsigned wrt, const size_t* rows, size_t row_count,
                         const wavetracer_frame& frame) {
  constexpr unsigned known = WAVETRACER_WRT_MATERIALS | WAVETRACER_WRT_POSITIONS | WAVETRACER_WRT_ORIENTATIONS;
  if (wrt == 0 || (wrt & ~known) != 0)
    throw ConfigError(std::string(function) + ": wrt is " + std::to_string(wrt) +
                      ", which is no sum of enum wavetracer_wrt");
  GradientChoice out{.materials = (wrt & WAVETRACER_WRT_MATERIALS) != 0,
                     .positions = (wrt & WAVETRACER_WRT_POSITIONS) != 0,
                     .orientations = (wrt & WAVETRACER_WRT_ORIENTATIONS) != 0};
  if (!rows) return out;
  out.paths.emplace();
  for (size_t i = 0; i < row_count; ++i) {
    check_row(function, frame, rows[i]);
    out.paths->push_back(static_cast<uint32_t>(rows[i]));
  }
  return out;
}

template <class Enum>
std::vector<uint8_t> numbers_of(const std::vector<Enum>& values) {
  std::vector<uint8_t> out(values.size());
  std::ranges::transform(values, out.begin(), [](Enum value) { return static_cast<uint8_t>(value); });
  return out;
}

::wavetracer_gradient* packed_gradient(PathGradients of, const Paths& paths) {
  const size_t ports = size_t{paths.rx_ports} * paths.tx_ports;
  std::vector<std::complex<double>> packed;
  for (const auto& a : of.a) packed.insert(packed.end(), a.begin(), a.begin() + static_cast<std::ptrdiff_t>(ports));
  std::vector<uint8_t> parameter = numbers_of(of.parameter), gap = numbers_of(of.gap);
  return new ::wavetracer_gradient{std::move(of), ports, std::move(parameter), std::move(gap), std::move(packed)};
}

wavetracer_column column_of(const ::wavetracer_gradient& gradient, std::string_view name) {
  const PathGradients& of = gradient.of;
  if (name == "first") return view(of.first);
  if (name == "parameter") return view(gradient.parameter);
  if (name == "material") return view(of.material);
  if (name == "a") return checked({gradient.a.data(), of.size(), gradient.ports, WAVETRACER_COMPLEX128});
  if (name == "delay_s") return view(of.delay_s);
  if (name == "aod_theta_rad") return view(of.aod_theta_rad);
  if (name == "aod_phi_rad") return view(of.aod_phi_rad);
  if (name == "aoa_theta_rad") return view(of.aoa_theta_rad);
  if (name == "aoa_phi_rad") return view(of.aoa_phi_rad);
  if (name == "gap") return view(gradient.gap);
  throw ConfigError("a gradient has no column \"" + std::string(name) + "\"; gradient.h lists them");
}

}  // namespace
}  // namespace wavetracer::c_api

using namespace wavetracer::c_api;
using wavetracer::ConfigError;

extern "C" {

wavetracer_gradient* wavetracer_frame_gradient(wavetracer_simulation* self, const wavetracer_frame* frame, unsigned wrt,
                                               const size_t* rows, size_t row_count, wavetracer_error** error) {
  return guarded(error, static_cast<wavetracer_gradient*>(nullptr), [&] {
    const char* const here = "wavetracer_frame_gradient";
    needed(self, here, "self");
    const wavetracer_frame& of = needed(frame, here, "frame");
    check_owner(here, *self, of);
    const wavetracer::GradientChoice choice = choice_of(here, wrt, rows, row_count, of);
    const Turn turn(*self, here);
    return packed_gradient(self->simulation.gradient(of.result, choice), of.result.paths);
  });
}

void wavetracer_gradient_free(wavetracer_gradient* self) { delete self; }

int wavetracer_gradient_column(const wavetracer_gradient* self, const char* name, wavetracer_column* column,
                               wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_gradient_column";
    needed(column, here, "column") = column_of(needed(self, here, "self"), &needed(name, here, "name"));
    return 1;
  });
}

size_t wavetracer_gradient_material_count(const wavetracer_gradient* self) {
  return self ? self->of.materials.size() : 0;
}
const char* wavetracer_gradient_material_name(const wavetracer_gradient* self, size_t index) {
  return index < wavetracer_gradient_material_count(self) ? self->of.materials[index].c_str() : nullptr;
}

}  // extern "C"
