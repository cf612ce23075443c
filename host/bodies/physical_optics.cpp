// SPDX-License-Identifier: Apache-2.0
#include "bodies/physical_optics.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "bodies/lit_parts.hpp"
#include "bodies/pieces.hpp"
#include "radio/constants.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Sum = std::array<std::complex<double>, 4>;

struct LitPart {
  size_t beam;  // its place among those of this bounce
  uint32_t facet;
  Polygon part;
};

// All that the beams light, in the order of beams and facets. A task is a beam and some hundred facets.
std::vector<LitPart> lit_parts(const Body& body, const LitParts& lit, const std::vector<Beam>& beams) {
  constexpr size_t step = 256;
  const size_t facets = body.facets.size(), blocks = (facets + step - 1) / step;
  std::vector<std::vector<LitPart>> found(beams.size() * blocks);
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t task) {
    const size_t beam = task / blocks, first = task % blocks * step;
    for (size_t facet = first; facet < std::min(first + step, facets); ++facet)
      for (Polygon& part : lit(beams[beam], static_cast<uint32_t>(facet)))
        found[task].push_back({beam, static_cast<uint32_t>(facet), std::move(part)});
  });
  std::vector<LitPart> parts;
  for (std::vector<LitPart>& some : found) std::move(some.begin(), some.end(), std::back_inserter(parts));
  return parts;
}

void check_options(const PhysicalOptics& options, double frequency_hz) {
  const auto above_zero = [](const char* name, double value) {
    if (!(value > 0))
      throw ConfigError(fmt::format("{} of physical optics is {}; give it a number above 0", name, value));
  };
  above_zero("the frequency", frequency_hz);
  above_zero("phase_error_rad", options.phase_error_rad);
  above_zero("amplitude_error", options.amplitude_error);
  above_zero("echo_size_m", options.echo_size_m);
  if (options.max_bounces == 0)
    throw ConfigError("max_bounces of physical optics is 0, which leaves no echo; give it 1 or more");
}

void check_end(const Body& body, const char* name, glm::dvec3 end) {
  if (!std::isfinite(end.x + end.y + end.z))
    throw ConfigError(fmt::format("the {} of a body's echoes is not at a finite position; give it one", name));
  for (size_t i = 0; i < body.facets.size(); ++i) {
    const Plane plane = plane_of(body.facets[i].corners);
    if (std::abs(height_over(plane, end)) > 1e-6) continue;
    // The end lies in the plane: it is on the facet if it is on the inner side of all edges.
    const Polygon& corners = body.facets[i].corners;
    bool inside = true;
    for (size_t k = 0; k < corners.size() && inside; ++k) {
      const glm::dvec3 edge = corners[(k + 1) % corners.size()] - corners[k];
      inside = glm::dot(glm::cross(edge, end - corners[k]), plane.normal) >= -1e-6 * glm::length(edge);
    }
    if (inside)
      throw ConfigError(fmt::format("the {} of a body's echoes is on facet {}; move it away from the body", name, i));
  }
}

std::vector<Echo> one_way(const Body& body, const LitParts& lit, glm::dvec3 transmitter, glm::dvec3 receiver,
                          double wavelength_m, const PhysicalOptics& options) {
  const auto fits_echo = [&](const Polygon&, glm::dvec3, double radius_m) {
    return 2 * radius_m <= options.echo_size_m;
  };
  std::vector<Echo> echoes;
  std::vector<Beam> beams{{transmitter, {}, {}}};
  for (uint32_t bounce = 1; bounce <= options.max_bounces && !beams.empty(); ++bounce) {
    const std::vector<LitPart> parts = lit_parts(body, lit, beams);
    std::vector<std::vector<Echo>> found(parts.size());
    std::vector<Beam> next(bounce < options.max_bounces ? parts.size() : 0);
    tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
      const auto& [beam, facet, part] = parts[i];
      const FacetWave wave{body, lit, beams[beam], facet, receiver, wavelength_m};
      for (const Polygon& cell : pieces_of(part, fits_echo, 1e-6 * lit.size_m()))
        found[i].push_back(wave.echo(cell, options));
      if (!next.empty()) next[i] = lit.reflected(beams[beam], facet, part);
    });
    for (std::vector<Echo>& some : found) std::move(some.begin(), some.end(), std::back_inserter(echoes));
    beams = std::move(next);
  }
  return echoes;
}

void turn_back(Echo& echo) {
  std::reverse(echo.facets.begin(), echo.facets.end());
  std::reverse(echo.vertices.begin(), echo.vertices.end());
  std::swap(echo.matrix[1], echo.matrix[2]);
}

const Body& checked(const Body& body) {
  check_body(body);
  return body;
}

}  // namespace

ScatteringBody::ScatteringBody(Body body) : body_(std::move(body)), lit_(checked(body_)) {
  lower_m_ = upper_m_ = body_.facets[0].corners[0];
  for (const Facet& facet : body_.facets)
    for (const glm::dvec3& corner : facet.corners) {
      lower_m_ = glm::min(lower_m_, corner);
      upper_m_ = glm::max(upper_m_, corner);
    }
}

std::vector<Echo> ScatteringBody::scattered(glm::dvec3 transmitter, glm::dvec3 receiver, double frequency_hz,
                                            const PhysicalOptics& options) const {
  check_options(options, frequency_hz);
  check_end(body_, "transmitter", transmitter);
  check_end(body_, "receiver", receiver);
  const double wavelength_m = speed_of_light_m_s / frequency_hz;
  std::vector<Echo> echoes = one_way(body_, lit_, transmitter, receiver, wavelength_m, options);
  if (options.reciprocal) {
    std::vector<Echo> back = one_way(body_, lit_, receiver, transmitter, wavelength_m, options);
    for (Echo& echo : back) turn_back(echo);
    echoes.insert(echoes.end(), std::make_move_iterator(back.begin()), std::make_move_iterator(back.end()));
    for (Echo& echo : echoes)
      for (std::complex<double>& m : echo.matrix) m *= 0.5;
  }
  return echoes;
}

std::array<double, 4> ScatteringBody::cross_sections_m2(glm::dvec3 to_transmitter, glm::dvec3 to_receiver,
                                                        double frequency_hz, const PhysicalOptics& options) const {
  const glm::dvec3 middle = (lower_m_ + upper_m_) / 2.0, size = upper_m_ - lower_m_;
  // The phase of the far field is right to 2 pi / 800 over the body.
  const double far_m = std::max(1e6, 100 * glm::dot(size, size) * frequency_hz / speed_of_light_m_s);
  const Sum sum = sum_of(
      scattered(middle + to_transmitter * far_m, middle + to_receiver * far_m, frequency_hz, options), frequency_hz);
  std::array<double, 4> out;
  for (size_t i = 0; i < 4; ++i) out[i] = 4 * WT_PI * std::norm(sum[i] * far_m * far_m);
  return out;
}

std::vector<Echo> scattered(const Body& body, glm::dvec3 transmitter, glm::dvec3 receiver, double frequency_hz,
                            const PhysicalOptics& options) {
  return ScatteringBody(body).scattered(transmitter, receiver, frequency_hz, options);
}

Sum sum_of(const std::vector<Echo>& echoes, double frequency_hz) {
  Sum sum{};
  for (const Echo& echo : echoes) {
    const auto turn = device::wt_cos_sin(-2 * WT_PI * frequency_hz / speed_of_light_m_s * echo.length_m);
    for (size_t i = 0; i < 4; ++i) sum[i] += echo.matrix[i] * std::complex(turn.x, turn.y);
  }
  return sum;
}

std::array<double, 4> cross_sections_m2(const Body& body, glm::dvec3 to_transmitter, glm::dvec3 to_receiver,
                                        double frequency_hz, const PhysicalOptics& options) {
  return ScatteringBody(body).cross_sections_m2(to_transmitter, to_receiver, frequency_hz, options);
}

}  // namespace wavetracer
