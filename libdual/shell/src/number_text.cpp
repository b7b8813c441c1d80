#include "trivalent/shell/number_text.h"

#include <iomanip>
#include <sstream>

namespace trivalent::shell {

std::string decimals(double value, int n_decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(n_decimals) << value;
  return text.str();
}

std::string percent(double fraction) { return decimals(100.0 * fraction, 1) + " %"; }

std::string significant(double value, int n_digits) {
  std::ostringstream text;
  text << std::setprecision(n_digits) << value;
  return text.str();
}

std::string bytes_text(double bytes) {
  constexpr double megabyte = 1e6;
  constexpr double gigabyte = 1e9;
  return bytes < gigabyte ? decimals(bytes / megabyte, 0) + " MB"
                          : decimals(bytes / gigabyte, 1) + " GB";
}

}  // namespace trivalent::shell
