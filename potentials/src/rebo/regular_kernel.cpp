#include "rebo/regular_kernel.h"

#include "rebo/regular_kernel_variants.h"

namespace trivalent::potentials::rebo_detail {

RegularKernels usable_regular_kernels() {
  RegularKernels usable = {{regular_kernel_baseline, nullptr, nullptr}, 1};
#ifdef TRIVALENT_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    usable.kernels[usable.count++] = regular_kernel_avx2;
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    usable.kernels[usable.count++] = regular_kernel_avx512;
  }
#endif
  return usable;
}

RegularKernel best_regular_kernel() {
  const RegularKernels usable = usable_regular_kernels();
  return usable.kernels[usable.count - 1];
}

}  // namespace trivalent::potentials::rebo_detail
