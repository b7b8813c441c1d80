#pragma once

#include "rebo/regular_kernel.h"

namespace trivalent::potentials::rebo_detail {

// The same kernel compiled for different instruction sets.
void regular_kernel_baseline(const RegularArguments& arguments, const std::uint32_t* atoms,
                             std::size_t count, double* virial);
void regular_kernel_avx2(const RegularArguments& arguments, const std::uint32_t* atoms,
                         std::size_t count, double* virial);
void regular_kernel_avx512(const RegularArguments& arguments, const std::uint32_t* atoms,
                           std::size_t count, double* virial);

}  // namespace trivalent::potentials::rebo_detail
