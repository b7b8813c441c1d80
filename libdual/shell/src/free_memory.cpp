#include "free_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace trivalent::shell {
namespace {

constexpr double kib = 1024.0;

std::optional<double> free_on_machine() {
  std::ifstream in("/proc/meminfo");
  std::string key;
  double amount = 0.0;
  std::string unit;
  while (in >> key >> amount) {
    if (key == "MemAvailable:") return amount * kib;
    std::getline(in, unit);
  }
  return std::nullopt;
}

std::optional<double> number_in(const std::string& path) {
  std::ifstream in(path);
  double number = 0.0;
  // "max" is no number.
  return in >> number ? std::optional(number) : std::nullopt;
}

/// As containers and batch systems set it.
std::optional<double> free_in_control_group() {
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (!limit || !used) return std::nullopt;
  return *limit - *used;
}

std::optional<double> free_for_process() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  const auto pages = number_in("/proc/self/statm");
  if (!pages) return std::nullopt;
  return static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::optional<double> free_memory() {
  std::optional<double> least;
  for (const auto& part : {free_on_machine(), free_in_control_group(), free_for_process()}) {
    if (part) least = std::max(0.0, std::min(*part, least.value_or(*part)));
  }
  return least;
}

}  // namespace trivalent::shell
