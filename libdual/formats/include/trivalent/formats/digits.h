#pragma once

namespace trivalent::dual {

/// How real numbers appear in text files.
enum class Digits {
  ten_decimals,          ///< as in 1.4200000000
  seventeen_significant  ///< reads back to the same bits
};

}  // namespace trivalent::dual
