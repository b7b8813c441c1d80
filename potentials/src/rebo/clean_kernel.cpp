#include "rebo/clean_kernel.h"

#include "rebo/clean_kernel_variants.h"

namespace trivalent::potentials::rebo_detail {

CleanKernels usable_clean_kernels() {
  CleanKernels usable = {{clean_kernel_baseline, nullptr, nullptr}, 1};
#ifdef TRIVALENT_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    usable.kernels[usable.count++] = clean_kernel_avx2;
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    usable.kernels[usable.count++] = clean_kernel_avx512;
  }
#endif
  return usable;
}

CleanKernel best_clean_kernel() {
  const CleanKernels usable = usable_clean_kernels();
  return usable.kernels[usable.count - 1];
}

}  // namespace trivalent::potentials::rebo_detail
