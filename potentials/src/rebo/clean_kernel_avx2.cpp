#define TRIVALENT_LANES 4
#include "rebo/clean_kernel_impl.h"
#include "rebo/clean_kernel_variants.h"

namespace trivalent::potentials::rebo_detail {

void clean_kernel_avx2(const CleanArguments& arguments, const std::uint32_t* atoms,
                       std::size_t count, double* virial) {
  evaluate_clean_atoms(arguments, atoms, count, virial);
}

}  // namespace trivalent::potentials::rebo_detail
