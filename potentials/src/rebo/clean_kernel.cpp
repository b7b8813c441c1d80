#include "rebo/clean_kernel.h"

#include "rebo/clean_kernel_variants.h"

namespace trivalent::potentials::rebo_detail {

CleanKernel best_clean_kernel() {
#ifdef TRIVALENT_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return clean_kernel_avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return clean_kernel_avx2;
#endif
  return clean_kernel_baseline;
}

}  // namespace trivalent::potentials::rebo_detail
