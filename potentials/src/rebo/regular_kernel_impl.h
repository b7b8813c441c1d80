// The kernel for regular atoms, included once per instruction set with TRIVALENT_LANES atoms at a
// time.
//
// An atom is regular if it is a carbon with three carbon neighbors, all nearer than D_min, and no
// angle is nearly straight. Then all its cutoffs are 1 and its coordination is an integer: nothing
// depends on them. A bond is conjugated if this holds at both ends and no neighbor of them has more
// than three: then F(2, 2, 9) = 0 and T(2, 2, 9) is a constant, and what is left of [Brenner2002]
// is
//
//   E = Σ_i Σ_a ½ V_R(a) - ½ V_A(a) [ p_a + T D_a ],   p_a = [1 + P + Σ_{b≠a} g(cosθ_ab)]^(-1/2),
//   D_a = Σ_kl (1 - (m_k·n_l)² / (m_k² n_l²)),
//
// with a, b the bonds of atom i, m_k = a × k for its other bonds k, and n_l = a × l for the other
// bonds l of the atom at the end of a. Other bonds of regular atoms lack the term T D here;
// IrregularAtom adds what they have instead. Each atom takes the derivatives of its own p, and of D
// through its own normals m; the atom at the other end takes those through n. So no two atoms write
// to the same place.

#include "rebo/regular_kernel.h"

namespace trivalent::potentials::rebo_detail {
namespace {

constexpr int lanes = TRIVALENT_LANES;
using Real = double __attribute__((vector_size(sizeof(double) * lanes)));
using Integer = long long __attribute__((vector_size(sizeof(long long) * lanes)));

#define TRIVALENT_INLINE inline __attribute__((always_inline))

struct Vector {
  Real x, y, z;
};

TRIVALENT_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TRIVALENT_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
TRIVALENT_INLINE Vector operator*(const Real& s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
TRIVALENT_INLINE Real dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
TRIVALENT_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

TRIVALENT_INLINE Real square_root(const Real& x) {
  alignas(sizeof(Real)) double values[lanes];
  __builtin_memcpy(values, &x, sizeof(x));
  for (int l = 0; l < lanes; ++l) values[l] = __builtin_sqrt(values[l]);
  Real result;
  __builtin_memcpy(&result, values, sizeof(x));
  return result;
}

// exp(x) for |x| < 700: x = n ln 2 + r, then the Taylor series of exp(r) to r^12, whose next term
// is below half a unit in the last place for |r| <= ln 2 / 2.
TRIVALENT_INLINE Real exponential(const Real& x) {
  constexpr double log2_e = 0x1.71547652b82fep0;
  constexpr double ln2_high = 0x1.62e42fefa3800p-1;  // ends in zeros: n times it is exact
  constexpr double ln2_low = 0x1.ef35793c76730p-45;
  // Adding this leaves n in the lowest bits of the sum, biased like an exponent.
  constexpr double shifter = 0x1.8p52 + 1023.0;
  const Real shifted = x * log2_e + shifter;
  const Real n = shifted - shifter;
  const Real r = (x - n * ln2_high) - n * ln2_low;
  Real sum = r * (1.0 / 479001600.0) + 1.0 / 39916800.0;
  sum = sum * r + 1.0 / 3628800.0;
  sum = sum * r + 1.0 / 362880.0;
  sum = sum * r + 1.0 / 40320.0;
  sum = sum * r + 1.0 / 5040.0;
  sum = sum * r + 1.0 / 720.0;
  sum = sum * r + 1.0 / 120.0;
  sum = sum * r + 1.0 / 24.0;
  sum = sum * r + 1.0 / 6.0;
  sum = sum * r + 0.5;
  sum = sum * r + 1.0;
  sum = sum * r + 1.0;
  return sum * (Real)((Integer)shifted << 52);
}

struct RealAndSlope {
  Real value, slope;
};

TRIVALENT_INLINE RealAndSlope angular_function(const RegularParameters& p, const Real& cosine) {
  Real c[6];
  for (int n = 0; n < 6; ++n) {
    c[n] = cosine < p.knots[0] ? Real{} + p.g[0][n] : Real{} + p.g[1][n];
    c[n] = cosine < p.knots[1] ? c[n] : Real{} + p.g[2][n];
    c[n] = cosine < p.knots[2] ? c[n] : Real{} + p.g[3][n];
  }
  RealAndSlope g = {c[5], Real{}};
  for (int n = 4; n >= 0; --n) {
    g.slope = g.slope * cosine + g.value;
    g.value = g.value * cosine + c[n];
  }
  return g;
}

TRIVALENT_INLINE RealAndSlope repulsion(const RegularParameters& p, const Real& r,
                                        const Real& inverse) {
  const Real decay = p.A * exponential(-p.alpha * r);
  const Real screening = 1.0 + p.Q * inverse;
  return {screening * decay, -(p.alpha * screening + p.Q * inverse * inverse) * decay};
}

TRIVALENT_INLINE RealAndSlope attraction(const RegularParameters& p, const Real& r) {
  RealAndSlope sum = {Real{}, Real{}};
  for (int n = 0; n < 3; ++n) {
    const Real term = p.B[n] * exponential(-p.beta[n] * r);
    sum.value += term;
    sum.slope -= p.beta[n] * term;
  }
  return sum;
}

// Where the atoms of one batch and their neighbors are.
struct Batch {
  std::uint32_t atom[lanes];
  std::uint32_t link[3][lanes];    // the three bonds
  std::uint32_t end[3][lanes];     // points at their ends
  std::uint32_t home[3][lanes];    // atoms those points are, or are images of
  std::uint32_t beyond[6][lanes];  // points at the ends of the other bonds of those atoms, by twos
  double T[3][lanes];              // dihedral factor; 0 if the bond is not conjugated
  bool has_images;
};

TRIVALENT_INLINE void find_neighbors(const RegularArguments& a, int l, Batch& batch) {
  const std::uint32_t atom = batch.atom[l];
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t link = a.first[atom] + (a.bonded[atom] >> 8 * k & 0xff);
    const std::uint32_t end = a.point[link];
    const bool is_image = end >= a.atom_count;
    const std::uint32_t home = is_image ? a.homes[end - a.atom_count] : end;
    batch.has_images |= is_image;
    batch.link[k][l] = link;
    batch.end[k][l] = end;
    batch.home[k][l] = home;
    const bool is_conjugated = ((a.states[atom] | a.states[home]) & atom_state::unconjugated) == 0;
    batch.T[k][l] = is_conjugated ? a.parameters->T : 0.0;
    if (!is_conjugated) {
      // The other end may have any number of bonds. Two points that exist will do.
      batch.beyond[2 * k][l] = end;
      batch.beyond[2 * k + 1][l] = end;
      continue;
    }
    const std::uint32_t first = a.first[home];
    const std::uint32_t packed = a.bonded[home];
    const std::uint32_t back = a.reverse[link] - first;
    const std::uint32_t o0 = packed & 0xff;
    const std::uint32_t o1 = packed >> 8 & 0xff;
    const std::uint32_t o2 = packed >> 16 & 0xff;
    batch.beyond[2 * k][l] = a.point[first + (back == o0 ? o1 : o0)];
    batch.beyond[2 * k + 1][l] = a.point[first + (back == o2 ? o1 : o2)];
  }
}

TRIVALENT_INLINE Vector load(const double* positions, const std::uint32_t* points) {
  Vector v;
  for (int l = 0; l < lanes; ++l) {
    const double* p = positions + std::size_t{4} * points[l];
    v.x[l] = p[0];
    v.y[l] = p[1];
    v.z[l] = p[2];
  }
  return v;
}

// Adds T·D's derivative through one normal m of the atom to `slope`; returns Σ_l cos²Θ.
TRIVALENT_INLINE Real overlap_of_planes(const Vector& m, const Real& inverse_m2,
                                        const Vector (&n)[2], const Real (&inverse_n2)[2],
                                        Real weight, Vector& slope) {
  Real sum = {};
  for (int l = 0; l < 2; ++l) {
    const Real t = dot(m, n[l]);
    const Real over = t * inverse_m2;
    sum += t * over * inverse_n2[l];
    const Real scale = (weight + weight) * over * inverse_n2[l];
    slope = slope + scale * (n[l] - over * m);
  }
  return sum;
}

TRIVALENT_INLINE void evaluate_batch(const RegularArguments& a, const Batch& batch, int used,
                                     Real (&virial)[6]) {
  const RegularParameters& p = *a.parameters;
  const Vector center = load(a.positions, batch.atom);
  Vector bond[3];
  Vector direction[3];
  Real r[3];
  Real inverse[3];
  Vector end[3];
  for (int k = 0; k < 3; ++k) {
    end[k] = load(a.positions, batch.end[k]);
    bond[k] = end[k] - center;
    r[k] = square_root(dot(bond[k], bond[k]));
    inverse[k] = 1.0 / r[k];
    direction[k] = inverse[k] * bond[k];
  }

  // Angle number k lies between the two bonds other than k.
  Real cosine[3];
  RealAndSlope g[3];
  Vector normal[3];
  Real inverse_m2[3];
  Vector normal_slope[3];
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    cosine[k] = dot(direction[u], direction[v]);
    g[k] = angular_function(p, cosine[k]);
    normal[k] = cross(bond[u], bond[v]);
    inverse_m2[k] = 1.0 / dot(normal[k], normal[k]);
    normal_slope[k] = {Real{}, Real{}, Real{}};
  }

  Vector slope[3];
  Real from_other_end[3];
  Real sum_slope[3];  // dE/d(Σ g) of each bond's p
  Real energy = {};
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    const RealAndSlope repelled = repulsion(p, r[k], inverse[k]);
    const RealAndSlope attracted = attraction(p, r[k]);
    const Real sum = 1.0 + p.p_constant + g[u].value + g[v].value;
    const Real order = 1.0 / square_root(sum);
    sum_slope[k] = 0.25 * attracted.value * order / sum;

    Real T;
    __builtin_memcpy(&T, batch.T[k], sizeof(T));
    const Vector origin = batch.has_images ? load(a.positions, batch.home[k]) : end[k];
    Vector n[2];
    Real inverse_n2[2];
    for (int l = 0; l < 2; ++l) {
      n[l] = cross(bond[k], load(a.positions, batch.beyond[2 * k + l]) - origin);
      inverse_n2[l] = 1.0 / (T == 0.0 ? Real{} + 1.0 : dot(n[l], n[l]));
    }
    // D = 4 - Σ cos²Θ, and its factor in the energy of the bond is -V_A T.
    const Real weight = attracted.value * T;
    const Real overlap =
        overlap_of_planes(normal[u], inverse_m2[u], n, inverse_n2, weight, normal_slope[u]) +
        overlap_of_planes(normal[v], inverse_m2[v], n, inverse_n2, weight, normal_slope[v]);
    const Real twist = T * (4.0 - overlap);

    from_other_end[k] = -0.25 * attracted.value * order;
    energy += 0.5 * (repelled.value - attracted.value * twist) + from_other_end[k];
    slope[k] = (0.5 * (repelled.slope - attracted.slope * (order + twist))) * direction[k];
  }

  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    const Real slope_cosine = (sum_slope[u] + sum_slope[v]) * g[k].slope;
    slope[u] = slope[u] + (slope_cosine * inverse[u]) * (direction[v] - cosine[k] * direction[u]) +
               cross(bond[v], normal_slope[k]);
    slope[v] = slope[v] + (slope_cosine * inverse[v]) * (direction[u] - cosine[k] * direction[v]) +
               cross(normal_slope[k], bond[u]);
  }

  Real stress[6] = {};
  for (int k = 0; k < 3; ++k) {
    stress[0] -= slope[k].x * bond[k].x;
    stress[1] -= slope[k].y * bond[k].y;
    stress[2] -= slope[k].z * bond[k].z;
    stress[3] -= slope[k].x * bond[k].y;
    stress[4] -= slope[k].x * bond[k].z;
    stress[5] -= slope[k].y * bond[k].z;
  }
  for (int l = used; l < lanes; ++l) {
    for (Real& component : stress) component[l] = 0.0;
  }
  for (int c = 0; c < 6; ++c) virial[c] += stress[c];

  for (int l = 0; l < used; ++l) {
    a.energies[batch.atom[l] - a.first_atom] = energy[l];
    for (int k = 0; k < 3; ++k) {
      double* out = a.slopes + std::size_t{4} * (batch.link[k][l] - a.first_link);
      out[0] = slope[k].x[l];
      out[1] = slope[k].y[l];
      out[2] = slope[k].z[l];
      out[3] = from_other_end[k][l];
    }
  }
}

void evaluate_regular_atoms(const RegularArguments& arguments, const std::uint32_t* atoms,
                            std::size_t count, double* virial) {
  Real sum[6] = {};
  for (std::size_t begin = 0; begin < count; begin += lanes) {
    const int used = count - begin < lanes ? static_cast<int>(count - begin) : lanes;
    Batch batch;
    batch.has_images = false;
    for (int l = 0; l < lanes; ++l) {
      // A last batch that is not full is filled up with its last atom.
      batch.atom[l] = atoms[begin + static_cast<std::size_t>(l < used ? l : used - 1)];
      find_neighbors(arguments, l, batch);
    }
    evaluate_batch(arguments, batch, used, sum);
  }
  for (int c = 0; c < 6; ++c) {
    for (int l = 0; l < lanes; ++l) virial[c] += sum[c][l];
  }
}

}  // namespace
}  // namespace trivalent::potentials::rebo_detail
