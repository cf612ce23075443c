// Wedge diffraction in double: four terms, each the jump of a geometrical wave at its shadow boundary times a function
// that is half of that jump on either side of the boundary. Local axes: x along face 0, y its normal, z along the edge.
#include "radio/utd.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "radio/slab.hpp"
#include "radio/transition.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double undecided_rad = 1e-6;  // a caller's geometry, in double from the same points, is no further off
constexpr double grazing_rad = 1e-9;

// Edge-fixed bases of a wave that comes to the edge and of one that leaves it; (beta, phi, k) is right-handed.
SphericalBasis leaving(const glm::dvec3& along, const glm::dvec3& k) {
  const glm::dvec3 phi = glm::normalize(glm::cross(along, k));
  return {glm::cross(phi, k), phi};
}
SphericalBasis coming(const glm::dvec3& along, const glm::dvec3& k) { return leaving(-along, k); }

// Of a direction that points away from the edge, 0 to exterior_rad.
double azimuth_of(const WedgeFrame& wedge, const glm::dvec3& away) {
  double azimuth = std::atan2(glm::dot(away, wedge.normal), glm::dot(away, wedge.face));
  if (azimuth < 0) azimuth += 2 * pi;
  if (azimuth <= wedge.exterior_rad) return azimuth;
  return azimuth - wedge.exterior_rad < 2 * pi - azimuth ? wedge.exterior_rad : 0;
}

// The matrix of the wave the other way, between the edge-fixed bases that belong to that way: beta changes its sign.
Matrix2 reversed(const Matrix2& m) { return {m[0], -m[2], -m[1], m[3]}; }

// The geometrical waves around a wedge, as matrices from (beta', phi') to (beta, phi), for one angle with the edge.
class Corner {
 public:
  Corner(double exterior_rad, const std::array<WedgeFace, 2>& faces, double cosine, double wavelength_m)
      : normals_{{{0, 1, 0}, {std::sin(exterior_rad), -std::cos(exterior_rad), 0}}},
        faces_(faces),
        cosine_(cosine),
        sine_(std::sqrt((1 - cosine) * (1 + cosine))),
        wavelength_m_(wavelength_m) {}

  // From a source at this azimuth, reflected |image| times: at face 0, 1, 0, ... if image < 0, at 1, 0, 1, ... if > 0.
  Matrix2 reflected(double azimuth, int image) const { return met(azimuth, image > 0, std::abs(image), false); }
  // Straight through `count` faces, `first` first.
  Matrix2 transmitted(double azimuth, bool first, int count) const { return met(azimuth, first, count, true); }

 private:
  Matrix2 met(double azimuth, bool first, int count, bool straight) const {
    constexpr glm::dvec3 along{0, 0, 1};
    glm::dvec3 k{-sine_ * std::cos(azimuth), -sine_ * std::sin(azimuth), cosine_};
    Transfer transfer(coming(along, k));
    for (int i = 0; i < count; ++i) {
      const size_t face = first != (i % 2 == 1);
      const glm::dvec3 out = straight ? k : glm::reflect(k, normals_[face]);
      const SlabCoefficients slab = coefficients(face, std::min(std::abs(glm::dot(k, normals_[face])), 1.0));
      if (straight)
        transfer.meet(k, out, normals_[face], slab.transmission_te, slab.transmission_tm);
      else
        transfer.meet(k, out, normals_[face], slab.reflection_te, slab.reflection_tm);
      k = out;
    }
    return transfer.seen_in(leaving(along, k));
  }

  SlabCoefficients coefficients(size_t face, double cos_theta) const {
    if (std::isinf(std::abs(faces_[face].permittivity))) return {-1.0, 1.0, 0.0, 0.0};
    return slab_coefficients(faces_[face].permittivity, cos_theta, faces_[face].thickness_m, wavelength_m_);
  }

  std::array<glm::dvec3, 2> normals_;
  const std::array<WedgeFace, 2>& faces_;
  double cosine_, sine_, wavelength_m_;
};

// A shadow boundary. Reflection unfolds: a geometrical wave is a straight line past the edge, from an azimuth to one
// that differs by less than pi, and each face in between reflects it. At the boundary they differ by just pi;
// epsilon_rad is by how much less, so the wave is there if it is positive.
struct Boundary {
  double epsilon_rad;
  int turn;   // +1, -1: unfolded, the receiver's azimuth is larger, smaller than the source's
  int image;  // as Corner::reflected has it
};

// The boundary nearest to these azimuths of the images of an even number of reflections (odd = false) or of an odd one:
// pi +- beta = 2 pi n N + epsilon, with Kouyoumjian and Pathak's N.
Boundary nearest_boundary(double azimuth_in, double azimuth_out, double exterior_rad, bool odd, int turn) {
  const double beta = odd ? azimuth_out + azimuth_in : azimuth_in - azimuth_out, period = 2 * exterior_rad;
  const double angle = pi + turn * beta, number = std::round(angle / period);
  return {angle - number * period, turn, turn * 2 * static_cast<int>(number) - odd};
}

// cot(epsilon / 2n) F(k L a) / sqrt(2 k L), a = 2 sin^2(epsilon / 2): F(x) = sqrt(x) g(sqrt x) takes the pole away.
Complex boundary_term(double epsilon_rad, double n, double root_2kl) {
  const double size = std::abs(epsilon_rad), sine = std::abs(std::sin(size / 2));
  const double ratio = size == 0 ? n : sine / std::tan(size / (2 * n));
  return std::copysign(ratio, epsilon_rad) * transition_over_root(root_2kl * sine);
}

double decided(const Boundary& boundary, const LitSides& lit) {
  if (std::abs(boundary.image) > 1 || std::abs(boundary.epsilon_rad) > undecided_rad) return boundary.epsilon_rad;
  const std::optional<bool>& known = boundary.image == 0 ? lit.direct : lit.reflected[boundary.image > 0];
  return known ? std::copysign(boundary.epsilon_rad, *known ? 1.0 : -1.0) : boundary.epsilon_rad;
}

void add(Matrix2& sum, Complex factor, const Matrix2& m) {
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += factor * m[i];
}

}  // namespace

Diffraction diffract(const WedgeFrame& wedge, const std::array<WedgeFace, 2>& faces, const glm::dvec3& k_in,
                     const glm::dvec3& k_out, double distance_m, double wavelength_m, bool transmits,
                     const LitSides& lit) {
  const double cosine = std::clamp((glm::dot(k_in, wedge.along) + glm::dot(k_out, wedge.along)) / 2, -1.0, 1.0);
  // Within 1e-9 of the edge, half of the digits of a double, azimuths mean nothing.
  const bool parallel =
      std::min(glm::length(glm::cross(k_in, wedge.along)), glm::length(glm::cross(k_out, wedge.along))) < 1e-9;
  if (parallel) return {{wedge.face, wedge.normal}, {wedge.face, wedge.normal}, {}};

  const double exterior = wedge.exterior_rad, n = exterior / pi;
  const bool convex = exterior >= pi, half_plane = exterior > 2 * pi - grazing_rad;
  const double in = azimuth_of(wedge, -k_in), out = azimuth_of(wedge, k_out);
  const Corner there(exterior, faces, cosine, wavelength_m), back(exterior, faces, -cosine, wavelength_m);

  // The jump of the geometrical field at a boundary, from shadow to light.
  const auto jump = [&](const Boundary& boundary, bool odd) {
    const int turn = boundary.turn;
    // Outside of a convex wedge nothing is reflected twice: one reflection, at the face on this side, is all.
    const int image = !convex ? boundary.image : odd ? turn : 0;
    // On the boundary both choices of angles agree; between boundaries their mean makes the coefficient reciprocal.
    Matrix2 matrix{};
    add(matrix, 0.5, there.reflected(in, image));
    add(matrix, 0.5, reversed(back.reflected(out, odd ? image : -image)));
    if (!odd && transmits && convex) {
      const int count = half_plane ? 1 : 2;
      add(matrix, -0.5, there.transmitted(in, turn < 0, count));
      add(matrix, -0.5, reversed(back.transmitted(out, turn > 0, count)));
    }
    return matrix;
  };

  const double root_2kl = std::sqrt(4 * pi * distance_m / wavelength_m);
  Matrix2 coefficient{};
  for (const bool odd : {false, true}) {
    for (const int turn : {-1, 1}) {
      const Boundary boundary = nearest_boundary(in, out, exterior, odd, turn);
      add(coefficient, boundary_term(decided(boundary, lit), n, root_2kl), jump(boundary, odd));
    }
  }
  const bool grazing = std::min(in, out) < grazing_rad || exterior - std::max(in, out) < grazing_rad;
  const Complex factor = -std::polar(std::sqrt(distance_m / pi) / (2 * n) * (grazing ? 0.5 : 1.0), -pi / 4);
  for (Complex& element : coefficient) element *= factor;

  const SphericalBasis from = coming(wedge.along, k_in), to = leaving(wedge.along, k_out);
  return {{from.theta, from.phi}, {to.theta, to.phi}, coefficient};
}

}  // namespace wavetracer
