// The effective roughness model, made reciprocal; its random phases are hashes, the same on every machine.
// Assumes unit vectors and a whole exponent of the lobe, as materials are checked to have.
#include "radio/scattering.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "radio/slab.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

// TE and TM of a wave. Along the normal any direction serves as TE; -k has it reversed there too, as elsewhere.
std::array<glm::dvec3, 2> polarizations(const glm::dvec3& k, const glm::dvec3& normal) {
  const glm::dvec3 across = glm::cross(k, normal);
  const double sine = glm::length(across);
  const glm::dvec3 least_along = std::abs(k.x) < 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
  const glm::dvec3 te = sine > 1e-8 ? across / sine : glm::normalize(glm::cross(k, least_along));
  return {te, glm::cross(te, k)};
}

// The finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014): a bijection that mixes every bit.
uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

enum class Pair : uint64_t { te_te, tm_tm, te_tm };

Complex random_phase(uint64_t seed, uint32_t tile, Pair pair) {
  const uint64_t bits = mixed(mixed(seed + 0x9E3779B97F4A7C15u) + 3 * uint64_t{tile} + static_cast<uint64_t>(pair));
  return std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(bits >> 11) * 0x1p-53);
}

double cosine(const glm::dvec3& k, const glm::dvec3& normal) { return std::min(std::abs(glm::dot(k, normal)), 1.0); }

}  // namespace

double lobe_integral(uint32_t alpha, double cos_theta) {
  const double quarter_sine2 = (1 - cos_theta * cos_theta) / 4;
  double sum = 0, binomial = std::ldexp(1.0, -static_cast<int>(alpha));  // of (alpha, j), over 2^alpha
  double series = 0, term = 1;  // sum over w of (2w, w) (sin^2 theta / 4)^w, up to w = (j - 1) / 2
  for (uint32_t j = 0; j <= alpha; ++j) {
    if (j % 2 == 1) {
      const double w = (j - 1) / 2;
      series += term;
      term *= quarter_sine2 * 2 * (2 * w + 1) / (w + 1);
    }
    sum += binomial * 2 * std::numbers::pi / (j + 1) * (j % 2 == 1 ? cos_theta * series : 1);
    binomial *= static_cast<double>(alpha - j) / (j + 1);
  }
  return sum;
}

double scattering_pattern(uint32_t alpha, double cos_in, double cos_out, double cos_psi) {
  if (alpha == 0) return cos_in * cos_out / std::numbers::pi;
  const double lobe = std::pow(std::clamp((1 + cos_psi) / 2, 0.0, 1.0), alpha);
  // cos(theta) / F grows with cos(theta): the smaller of both directions is that of the more grazing one.
  const double grazing = std::min(cos_in, cos_out);
  return lobe * grazing / lobe_integral(alpha, grazing);
}

ScatteredWave scatter(const Material& material, Complex permittivity, double wavelength_m, const glm::dvec3& k_in,
                      const glm::dvec3& k_out, const glm::dvec3& normal, double area_m2, uint64_t seed, uint32_t tile) {
  const double cos_in = cosine(k_in, normal), cos_out = cosine(k_out, normal);
  // Square roots of |R|, of TE and TM.
  const auto roots = [&](double cos_theta) -> std::array<double, 2> {
    const SlabCoefficients slab = slab_coefficients(permittivity, cos_theta, material.thickness_m, wavelength_m);
    return {std::sqrt(std::abs(slab.reflection_te)), std::sqrt(std::abs(slab.reflection_tm))};
  };
  const std::array<double, 2> in = roots(cos_in), out = roots(cos_out);
  const double cos_psi = glm::dot(glm::reflect(k_in, normal), k_out);
  const auto alpha = static_cast<uint32_t>(material.scattering_lobe);
  const double amplitude_m =
      material.scattering * std::sqrt(area_m2 * scattering_pattern(alpha, cos_in, cos_out, cos_psi));
  const double same = amplitude_m * std::sqrt(1 - material.scattering_cross_polar);
  const Complex other =
      amplitude_m * std::sqrt(material.scattering_cross_polar) * random_phase(seed, tile, Pair::te_tm);
  // On the way back both TE vectors are reversed and the TM vectors are not: the transposed dyad has a minus here.
  return {polarizations(k_in, normal),
          polarizations(k_out, normal),
          {same * out[0] * in[0] * random_phase(seed, tile, Pair::te_te), other * out[0] * in[1],
           -other * out[1] * in[0], same * out[1] * in[1] * random_phase(seed, tile, Pair::tm_tm)}};
}

double specular_share(const Material& material) { return std::sqrt(1 - material.scattering * material.scattering); }

}  // namespace wavetracer
