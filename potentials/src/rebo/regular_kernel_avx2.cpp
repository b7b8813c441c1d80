#define TRIVALENT_LANES 4
#include "rebo/regular_kernel_impl.h"
#include "rebo/regular_kernel_variants.h"

namespace trivalent::potentials::rebo_detail {

void regular_kernel_avx2(const RegularArguments& arguments, const std::uint32_t* atoms,
                         std::size_t count, double* virial) {
  evaluate_regular_atoms(arguments, atoms, count, virial);
}

}  // namespace trivalent::potentials::rebo_detail
