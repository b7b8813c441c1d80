#pragma once

#include "rebo/clean_kernel.h"

namespace trivalent::potentials::rebo_detail {

// The same kernel compiled for different instruction sets.
void clean_kernel_baseline(const CleanArguments& arguments, const std::uint32_t* atoms,
                           std::size_t count, double* virial);
void clean_kernel_avx2(const CleanArguments& arguments, const std::uint32_t* atoms,
                       std::size_t count, double* virial);
void clean_kernel_avx512(const CleanArguments& arguments, const std::uint32_t* atoms,
                         std::size_t count, double* virial);

}  // namespace trivalent::potentials::rebo_detail
